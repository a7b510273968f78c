// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/display_surface.h"
#include "sublimit/source/curvature.h"

#include <Eigen/Geometry>

#include <cmath>

namespace sublimit::asset {
namespace {

using Value = std::optional<std::array<double, 2>>;

Value value(const LimitSamples& s, Index row) {
  const std::optional<Curvature> c = curvature(s, row);
  if (!c || !std::isfinite(c->mean) || !std::isfinite(c->gauss)) return std::nullopt;
  return std::array{c->mean, c->gauss};
}

/// A little way into the face, to where no seam is: these have few binary digits.
Place moved_in(const Place& s, bool triangles) {
  const double middle_u = triangles ? 1. / 3 : .53, middle_v = triangles ? 1. / 3 : .5625, part = .0473;
  return {s.face, s.u + part * (middle_u - s.u), s.v + part * (middle_v - s.v)};
}

}  // namespace

AssetSurface display_surface(const LimitMap& surface, const LimitSurface& bound, const LimitTraits& traits,
                             Index faces) {
  const bool triangles = surface.addresses().triangles();
  const Index addresses = surface.addresses().size();
  if (std::int64_t(addresses) > 10 * std::int64_t(faces)) return {};
  int N = 2;
  const auto finer = [&] {
    return traits.polynomial ? N + 1 : (traits.thirds ? 3 : 2) * (N - 1) + 1;  // others are known at such places
  };
  while (N < 65 && std::int64_t(addresses) * (finer() - 1) * (finer() - 1) <= faces) N = finer();
  const std::vector<Place> grid = surface.grid(N);
  // Sides that a crease divides keep their own normals.
  const LimitSamples s = bound.evaluate(grid, 2, true);

  const std::int64_t rows = s.position.rows();
  std::vector<std::int64_t> first(rows);
  for (std::int64_t i = 0; i < rows; ++i) first[i] = i;
  for (const auto& [row, owner] : shared_grid_places(surface.level().topology(), surface.addresses(), N, traits.dual))
    if ((s.normal.row(row) - s.normal.row(owner)).norm() < 1e-3) first[row] = owner;

  std::vector<Value> values(rows);
  std::vector<Place> beside;
  std::vector<std::int64_t> beside_of;
  std::vector<bool> used(rows, false);
  for (std::int64_t i = 0; i < rows; ++i) {
    if (first[i] != i) continue;
    values[i] = value(s, Index(i));
    if (values[i] || !traits.polynomial) continue;
    beside.push_back(moved_in(grid[i], triangles));
    beside_of.push_back(i);
  }
  const LimitSamples near = bound.evaluate(beside, 2, false);
  for (size_t k = 0; k < beside.size(); ++k) values[beside_of[k]] = value(near, Index(k));

  AssetSurface result;
  const auto add_face = [&](std::initializer_list<std::int64_t> corners) {
    result.face_sizes.push_back(Index(corners.size()));
    for (const std::int64_t c : corners) {
      used[first[c]] = true;
      result.face_vertices.push_back(Index(first[c]));
    }
  };
  const std::int64_t per_face = triangles ? std::int64_t(N) * (N + 1) / 2 : std::int64_t(N) * N;
  for (Index a = 0; a < addresses; ++a) {
    if (surface.level().holes[index(surface.addresses().place(a).face)]) continue;
    std::int64_t row = a * per_face;
    for (int j = 0; j + 1 < N; ++j) {
      const int width = triangles ? N - j : N;
      for (int i = 0; i + 1 < width; ++i) {
        const std::int64_t p = row + i, above = p + width;
        if (!triangles) {
          add_face({p, p + 1, above + 1, above});
          continue;
        }
        add_face({p, p + 1, above});
        if (i + 2 < width) add_face({p + 1, above + 1, above});
      }
      row += width;
    }
  }
  std::vector<Index> name(rows, -1);
  Index count = 0;
  for (std::int64_t i = 0; i < rows; ++i)
    if (used[i]) name[i] = count++;
  for (Index& v : result.face_vertices) v = name[v];
  result.positions.resize(count, 3);
  result.normals.resize(count, 3);
  result.curvature.resize(size_t(count));
  for (std::int64_t i = 0; i < rows; ++i) {
    if (!used[i]) continue;
    result.positions.row(name[i]) = s.position.row(i);
    result.normals.row(name[i]) = s.normal.row(i);
    result.curvature[size_t(name[i])] = values[i];
  }
  return result;
}

}  // namespace sublimit::asset

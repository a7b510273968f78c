// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/triangle_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/nets/triangle_blossom.h"

namespace sublimit {
namespace {

constexpr Barycentric along_u{-1, 1, 0}, along_v{-1, 0, 1};

}  // namespace

TrianglePatch::TrianglePatch(int degree, int level) : degree_(degree), level_(level) {
  if (degree < 1 || degree > max_degree)
    throw InvalidParameter("degree " + format_number(degree) + ": triangular patches have degrees 1 to " +
                           format_number(max_degree));
  if (level < 0) throw InvalidParameter("level " + format_number(level) + ": it must be 0 or more");
  // Of 2^level * degree steps a side.
  if (level > 10)
    throw ResourceError("a triangular patch quartered " + format_number(level) + " times: more points " +
                        "than 32-bit indices count");
  side_ = degree << level;
  num_faces_ = Index{1} << (2 * level);
}

TrianglePatch::Corner TrianglePatch::corner(Index face) const {
  Corner at;
  for (int l = level_ - 1; l >= 0; --l) {
    const Index quarter = (face >> (2 * l)) & 3, half = degree_ << l;
    const Index move = at.step * half;
    if (quarter == 1 || quarter == 3) at.j += move;
    if (quarter == 2 || quarter == 3) at.k += move;
    if (quarter == 3) at.step = -at.step;
  }
  return at;
}

std::vector<Index> TrianglePatch::slots(Index face) const {
  const Corner at = corner(face);
  std::vector<Index> points;
  points.reserve(size_t(lattice_size(degree_)));
  for (Index k = 0; k <= degree_; ++k)
    for (Index j = 0; j + k <= degree_; ++j) points.push_back(point(at.j + at.step * j, at.k + at.step * k));
  return points;
}

LimitStatus TrianglePatch::rows(const Place& place, int order, WeightRows& weights) const {
  // Barycentric coordinates that are 0 stay so: an edge is over its own control points.
  const Barycentric at{std::max(0.0, (1 - place.u) - place.v), place.u, place.v};
  constexpr std::array<std::array<const Barycentric*, 2>, 6> directions{{{nullptr, nullptr},
                                                                         {&along_u, nullptr},
                                                                         {&along_v, nullptr},
                                                                         {&along_u, &along_u},
                                                                         {&along_u, &along_v},
                                                                         {&along_v, &along_v}}};
  weights.setZero(order == 0 ? 1 : order == 1 ? 3 : 6, lattice_size(degree_));
  std::vector<Barycentric> arguments(size_t(degree_), at);
  for (Eigen::Index r = 0; r < weights.rows(); ++r) {
    const int times = r == 0 ? 0 : r < 3 ? 1 : 2;
    if (times > degree_) continue;
    double factor = 1;
    for (int d = 0; d < times; ++d) {
      arguments[size_t(degree_ - 1 - d)] = *directions[size_t(r)][size_t(d)];
      factor *= degree_ - d;
    }
    const std::vector<double> row = triangle_blossom(arguments);
    for (size_t i = 0; i < row.size(); ++i) weights(r, Eigen::Index(i)) = factor * row[i];
  }
  return LimitStatus::regular;
}

std::string TrianglePatch::type(Index) const { return "triangle" + format_number(degree_); }

Place TrianglePatch::place(const Parameters& parameters) const {
  double u = parameters.u, v = parameters.v;
  if (!(u >= 0 && v >= 0 && u + v <= 1))
    throw InvalidParameter("(" + format_number(u) + ", " + format_number(v) +
                           ") is outside the triangle u, v >= 0, u + v <= 1");
  Index face = 0;
  for (int l = 0; l < level_; ++l) {
    const Index quarter = u + v <= 0.5 ? 0 : u >= 0.5 ? 1 : v >= 0.5 ? 2 : 3;
    face = 4 * face + quarter;
    u *= 2, v *= 2;
    if (quarter == 1) u -= 1;
    if (quarter == 2) v -= 1;
    if (quarter == 3) u = 1 - u, v = 1 - v;
  }
  return {face, u, v};
}

Patch::Parameters TrianglePatch::parameters(const Place& place) const {
  const Corner at = corner(place.face);
  const double unit = std::ldexp(1.0, -level_);
  return {.u = double(at.j) / side_ + at.step * unit * place.u, .v = double(at.k) / side_ + at.step * unit * place.v};
}

Patch::Lengths TrianglePatch::lengths(Index face) const {
  const double length = std::ldexp(double(corner(face).step), -level_);
  return {length, length};
}

std::optional<Patch::BezierRows> TrianglePatch::bezier(Index) const {
  const Index size = lattice_size(degree_);
  return BezierRows{degree_, degree_, WeightRows::Identity(size, size)};
}

Patch::Refined TrianglePatch::refined() const {
  auto fine = std::make_shared<const TrianglePatch>(degree_, level_ + 1);
  // Each quarter's control points from its parent's: blossoms at its corners, the same for every face.
  constexpr Barycentric v0{1, 0, 0}, v1{0, 1, 0}, v2{0, 0, 1}, m01{.5, .5, 0}, m02{.5, 0, .5}, m12{0, .5, .5};
  constexpr Barycentric corners[4][3] = {{v0, m01, m02}, {m01, v1, m12}, {m02, m12, v2}, {m12, m02, m01}};
  std::vector<std::vector<double>> quarter_rows[4];
  std::vector<Barycentric> arguments;
  for (int q = 0; q < 4; ++q)
    for (Index k = 0; k <= degree_; ++k)
      for (Index j = 0; j + k <= degree_; ++j) {
        arguments.assign(size_t(degree_ - j - k), corners[q][0]);
        arguments.insert(arguments.end(), size_t(j), corners[q][1]);
        arguments.insert(arguments.end(), size_t(k), corners[q][2]);
        quarter_rows[q].push_back(triangle_blossom(arguments));
      }
  // Points on edges between faces have the same row from each: the first one's is taken.
  std::vector<std::pair<Index, size_t>> owners(size_t(fine->num_points()), {-1, 0});
  for (Index face = 0; face < fine->num_faces_; ++face) {
    const std::vector<Index> points = fine->slots(face);
    for (size_t i = 0; i < points.size(); ++i)
      if (owners[size_t(points[i])].first < 0) owners[size_t(points[i])] = {face, i};
  }
  SparseRows rows;
  std::vector<SparseRows::Term> terms;
  for (const auto& [face, i] : owners) {
    const std::vector<Index> points = slots(face / 4);
    const std::vector<double>& weights = quarter_rows[face % 4][i];
    terms.clear();
    for (size_t c = 0; c < points.size(); ++c)
      if (weights[c] != 0) terms.push_back({points[c], weights[c]});
    std::ranges::sort(terms, {}, &SparseRows::Term::first);
    for (const auto& [column, weight] : terms) rows.add(column, weight);
    rows.end_row();
  }
  std::vector<SparseRows::Row> spans;
  for (size_t r = 0; r < rows.size(); ++r) spans.push_back(rows[r]);
  return {std::move(fine), matrix_of(spans, num_points())};
}

}  // namespace sublimit

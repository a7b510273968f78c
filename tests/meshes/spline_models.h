// SPDX-License-Identifier: Apache-2.0
#pragma once
// Models of several spline patches: spheres, tori, cubes, and surfaces cut into pieces, with patches in any
// orientation.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit::testing {

struct SplineModel {
  std::vector<SplineSurface> surfaces{};
  std::vector<Points> columns{};
  Coordinates coordinates = Coordinates::plain;

  /// Returns the patches, which refer to this model.
  std::vector<PatchColumns> patches() const {
    std::vector<PatchColumns> result;
    for (size_t i = 0; i < surfaces.size(); ++i) result.push_back({&surfaces[i], columns[i]});
    return result;
  }
  /// Adds a patch whose control points the caller sets.
  void add(const Knots<double>& u, const Knots<double>& v) {
    surfaces.emplace_back(u, v);
    columns.push_back(Points::Zero(surfaces.back().num_points(), coordinates == Coordinates::homogeneous ? 4 : 3));
  }
  /// Adds a patch whose control points are a function of their Greville abscissae.
  template <class Function>
  void add(const Knots<double>& u, const Knots<double>& v, const Function& point) {
    add(u, v);
    const std::vector<double> in_u = u.greville(), in_v = v.greville();
    for (Index j = 0; j < v.num_points(); ++j)
      for (Index i = 0; i < u.num_points(); ++i)
        columns.back().row(i + u.num_points() * j) = point(in_u[size_t(i)], in_v[size_t(j)]);
  }
  void append(const SplineModel& other) {
    surfaces.insert(surfaces.end(), other.surfaces.begin(), other.surfaces.end());
    columns.insert(columns.end(), other.columns.begin(), other.columns.end());
  }
  SplineModel only(size_t patch) const { return {{surfaces[patch]}, {columns[patch]}, coordinates}; }
  /// Refines a model of one patch to other knots.
  void refine(const Knots<double>& u, const Knots<double>& v) {
    const SplineSurface fine(u, v);
    columns[0] = apply(refinement_matrix(surfaces[0], fine), columns[0]);
    surfaces[0] = fine;
  }
};

/// Returns the model with u reversed (bit 1), v reversed (bit 2), and then u and v exchanged (bit 4).
inline SplineModel arranged(const SplineModel& model, int arrangement) {
  const SplineSurface& from = model.surfaces[0];
  const auto turned = [](const Knots<double>& given, bool reversed) {
    std::vector<double> all(given.all().begin(), given.all().end());
    if (reversed) {
      std::ranges::reverse(all);
      for (double& t : all) t = given.begin() + (given.end() - t);
    }
    return Knots<double>::open(given.degree(), given.num_points(), all);
  };
  const bool in_u = arrangement & 1, in_v = arrangement & 2, exchanged = arrangement & 4;
  const Knots<double> u = turned(from.u(), in_u), v = turned(from.v(), in_v);
  SplineModel result{.coordinates = model.coordinates};
  result.add(exchanged ? v : u, exchanged ? u : v);
  const Index nu = u.num_points(), nv = v.num_points();
  for (Index j = 0; j < nv; ++j)
    for (Index i = 0; i < nu; ++i)
      result.columns[0].row(exchanged ? j + nv * i : i + nu * j) =
          model.columns[0].row((in_u ? nu - 1 - i : i) + nu * (in_v ? nv - 1 - j : j));
  return result;
}

/// Returns the two parts of a patch, cut at an inner knot of u.
inline std::array<SplineModel, 2> cut_in_u(SplineModel model, double t) {
  const int p = model.surfaces[0].u().degree();
  const auto times = int(std::ranges::count(model.surfaces[0].u().all(), t));
  model.refine(with_knot(model.surfaces[0].u(), t, p - times), model.surfaces[0].v());
  const std::span<const double> all = model.surfaces[0].u().all();
  const auto first = std::ranges::lower_bound(all, t);
  std::vector<double> before(all.begin(), first + p), after(first, all.end());
  before.push_back(t), after.insert(after.begin(), t);
  const Index in_left = Index(before.size()) - p - 1, in_all = model.surfaces[0].u().num_points();
  std::array<SplineModel, 2> halves;
  for (size_t h = 0; h < 2; ++h) {
    const Index begin = h == 0 ? 0 : in_left - 1, count = h == 0 ? in_left : in_all - in_left + 1;
    halves[h].coordinates = model.coordinates;
    halves[h].add(Knots<double>::open(p, count, h == 0 ? before : after), model.surfaces[0].v());
    for (Index j = 0; j < model.surfaces[0].v().num_points(); ++j)
      halves[h].columns[0].middleRows(count * j, count) = model.columns[0].middleRows(in_all * j + begin, count);
  }
  return halves;
}

/// Returns a profile (w x, w z, w) in v rotated about the z axis by the circle of nine points.
inline SplineModel turned_profile(const std::vector<std::array<double, 3>>& profile, const Knots<double>& v) {
  const double h = std::sqrt(0.5), cosine[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, sine[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  SplineModel model{.coordinates = Coordinates::homogeneous};
  model.add(Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), v);
  for (Index j = 0; j < std::ssize(profile); ++j)
    for (Index i = 0; i < 9; ++i) {
      const auto& [x, z, w] = profile[size_t(j)];
      const double omega = i % 2 == 0 ? 1 : h;
      model.columns[0].row(9 * j + i) << omega * cosine[i] * x, omega * sine[i] * x, omega * z, omega * w;
    }
  return model;
}
inline SplineModel nurbs_sphere() {
  const double h = std::sqrt(0.5);
  return turned_profile({{0, -1, 1}, {h, -h, h}, {1, 0, 1}, {h, h, h}, {0, 1, 1}},
                        Knots<double>::open(2, 5, {0, 0, 0, 1, 1, 2, 2, 2}));
}
/// Returns a torus with radii 3 and 1.
inline SplineModel nurbs_torus() {
  const double h = std::sqrt(0.5), x[] = {4, 4, 3, 2, 2, 2, 3, 4, 4}, z[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  std::vector<std::array<double, 3>> profile;
  for (int i = 0; i < 9; ++i) {
    const double w = i % 2 == 0 ? 1 : h;
    profile.push_back({w * x[i], w * z[i], w});
  }
  return turned_profile(profile, Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}));
}

/// Returns the cube [-1, 1]^3 with outward normals.
inline SplineModel bilinear_cube() {
  SplineModel model;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      model.add(bezier_knots<double>(1), bezier_knots<double>(1), [=](double u, double v) -> Eigen::RowVector3d {
        Eigen::RowVector3d x;
        x[axis] = side;
        x[(axis + 1) % 3] = 2 * (side > 0 ? u : v) - 1;
        x[(axis + 2) % 3] = 2 * (side > 0 ? v : u) - 1;
        return x;
      });
  return model;
}

}  // namespace sublimit::testing

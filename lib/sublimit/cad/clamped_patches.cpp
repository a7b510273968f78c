// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/clamped_patches.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/cad/triangle_thirds.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

struct SurfaceColumns {
  SplineSurface surface;
  Points columns;
};

/// The thirds of all triangles of a patch.
std::vector<SurfaceColumns> thirds_of(const TrianglePatch& patch, const Points& columns) {
  const Knots<double> knots = bezier_knots<double>(patch.degree());
  const std::array<Eigen::MatrixXd, 3> thirds = triangle_thirds(patch.degree());
  std::vector<SurfaceColumns> parts;
  for (Index face = 0; face < patch.faces().size; ++face) {
    const Points own = columns(patch.slots(face), Eigen::all);
    for (const Eigen::MatrixXd& third : thirds) parts.push_back({{knots, knots}, third * own});
  }
  return parts;
}

std::vector<SurfaceColumns> as_splines(const NamedPatch& source) {
  if (const auto* const spline = dynamic_cast<const SplineSurface*>(source.patch.get()))
    return {{*spline, source.columns}};
  if (const auto* const triangle = dynamic_cast<const TrianglePatch*>(source.patch.get()))
    return thirds_of(*triangle, source.columns);
  const Patch::Refined refined = source.patch->refined();
  if (const auto* const spline = dynamic_cast<const SplineSurface*>(refined.patch.get()))
    return {{*spline, apply(refined.S, source.columns)}};
  throw UnsupportedTopology(source.place + " is no B-spline, and CAD files have no other surface for it" +
                            (source.no_net.empty() ? "" : " (" + source.no_net + ")") +
                            "; leave it out, or put a B-spline in its place");
}

/// Where a direction starts, ends, and jumps in between.
std::vector<double> unbroken(const Knots<double>& knots) {
  std::vector<double> ends{knots.begin()};
  for (Index face = 1; face < knots.num_faces(); ++face)
    if (*knots.continuity(face, KnotSide::left) < 0) ends.push_back(knots.all()[knots.span(face)]);
  ends.push_back(knots.end());
  return ends;
}

bool is_clamped(const Knots<double>& knots) {
  const std::span<const double> all = knots.all();
  return !knots.is_closed() && all.front() == knots.begin() && all.back() == knots.end();
}

/// Parts between jumps, with their ends interpolated.
std::vector<SurfaceColumns> clamped_parts(SurfaceColumns whole) {
  const Knots<double>&u = whole.surface.u(), &v = whole.surface.v();
  const std::vector<double> in_u = unbroken(u), in_v = unbroken(v);
  std::vector<SurfaceColumns> parts;
  if (in_u.size() == 2 && in_v.size() == 2 && is_clamped(u) && is_clamped(v)) {
    parts.push_back(std::move(whole));
    return parts;
  }
  for (size_t j = 0; j + 1 < in_v.size(); ++j)
    for (size_t i = 0; i + 1 < in_u.size(); ++i) {
      const Knots<double> part_u = part_knots(u, in_u[i], in_u[i + 1]), part_v = part_knots(v, in_v[j], in_v[j + 1]);
      const SparseMatrix S = kronecker(part_matrix(v, part_v), part_matrix(u, part_u));
      parts.push_back({{part_u, part_v}, apply(S, whole.columns)});
    }
  return parts;
}

/// Weights that are 0 but for rounding would be points far away.
bool has_positive_weights(const Points& columns) {
  constexpr double smallest = 1e-12;  // of the largest
  return columns.col(3).minCoeff() > smallest * columns.col(3).maxCoeff();
}

void make_weights_positive(SurfaceColumns& part, const std::string& place) {
  constexpr int most_halvings = 5;
  if (part.columns.col(3).sum() < 0) part.columns = -part.columns;
  for (int round = 0; !has_positive_weights(part.columns); ++round) {
    if (round == most_halvings)
      throw UnsupportedTopology(place +
                                ": its denominator is 0 or below somewhere, or very near to that; CAD files take "
                                "weights above 0 only; cut that part off");
    const SplineSurface fine = halved(part.surface);
    part.columns = apply(refinement_matrix(part.surface, fine), part.columns);
    part.surface = fine;
  }
}

}  // namespace

ClampedPatches clamped_patches(std::span<const NamedPatch> patches) {
  const bool rational = std::ranges::any_of(
      patches, [](const NamedPatch& patch) { return patch.coordinates == Coordinates::homogeneous; });
  ClampedPatches result;
  if (rational) result.coordinates = Coordinates::homogeneous;
  for (size_t p = 0; p < patches.size(); ++p) {
    const NamedPatch& source = patches[p];
    check_columns(source.columns, source.patch->num_points(), source.coordinates);
    for (SurfaceColumns& whole : as_splines(source)) {
      if (whole.surface.u().degree() < 1 || whole.surface.v().degree() < 1)
        throw UnsupportedTopology(source.place +
                                  " has degree 0, and CAD files begin with 1; give it a degree of 1 or more");
      for (SurfaceColumns& part : clamped_parts(std::move(whole))) {
        if (source.coordinates == Coordinates::homogeneous)
          make_weights_positive(part, source.place);
        else if (rational)
          part.columns = homogeneous(part.columns, Eigen::VectorXd::Ones(part.columns.rows()));
        result.patches.push_back({std::move(part.surface), std::move(part.columns), p});
      }
    }
  }
  return result;
}

}  // namespace sublimit

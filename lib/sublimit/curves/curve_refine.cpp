// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/curve_refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sublimit/base/detail/memory.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/curves/detail/curve_levels.h"
#include "sublimit/scheme/detail/check_levels.h"

namespace sublimit {

double CurveLayout::parameter(const CurveOutline& c, int number, Index a) const {
  const int first = c.closed ? (dual_ ? 1 : 0) : kept_ ? 0 : -start_;
  return std::ldexp(static_cast<double>(position(c, a)), -number - 1) - first / 2.0;
}

std::vector<CurveLevel> refine(const CurveScheme<double>& scheme, const ControlPolygon& polygon, int levels,
                               const std::function<void(int)>& progress) {
  if (levels < 0) throw InvalidParameter("levels is " + std::to_string(levels) + "; it must be 0 or more");
  std::vector<CurveLevel> result{control_level(scheme, polygon)};
  // Before memory is taken: the last level doubles `levels` times.
  const std::string amount =
      std::to_string(levels) + " levels of " + std::to_string(result[0].num_points()) + " points";
  const double first = double(result[0].num_points()) * result[0].unknowns, points = std::ldexp(first, levels);
  constexpr double most_points = double(std::numeric_limits<Index>::max()) / 8;
  // Of all masks; all levels together are twice the last, and rows are appended to arrays that double.
  double terms = 0;
  for (int which : {0, 1})
    for (int component = 0; component < result[0].unknowns; ++component)
      terms += static_cast<double>(
          scheme.masks.child(which, component)(CurveSite<double>(0, result[0].unknowns)).terms().size());
  const double row = 2 * 1.5 * 12 * terms / (2 * result[0].unknowns) + 8;
  const double bytes = row + 7 * 8 * polygon.dimension();  // of a point
  const std::string advice =
      "use at most " + std::to_string(most_levels(first, 2, std::min(most_points, memory_limit() / bytes)));
  if (points > most_points)
    throw ResourceError(amount + " are more points than 32-bit indices can hold the weights of; " + advice);
  check_memory(amount, points * bytes, advice);
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    result.push_back(next_level(scheme, result.back()));
  }
  return result;
}

namespace {

/// Rows of one step over an open curve and a closed one, each long enough for a middle.
std::vector<SparseMatrix> sample_rows(const CurveScheme<double>& scheme, int level) {
  const CurveLayout layout(scheme, level);
  const Index size = 4 * (layout.radius() + layout.end_points() + 2);
  std::vector<SparseMatrix> rows;
  for (const bool closed : {false, true}) rows.push_back(curve_matrix(scheme, {layout.control(size, closed)}, level));
  return rows;
}

}  // namespace

void check_made_by(const CurveLevel& level, const CurveScheme<double>& scheme, const std::string& what) {
  if (!level.made_by) return;
  const CurveScheme<double>& other = *level.made_by;
  if (other.name == scheme.name) {
    const std::vector<SparseMatrix> a = sample_rows(scheme, level.number), b = sample_rows(other, level.number);
    if (std::equal(a.begin(), a.end(), b.begin(), has_same_bits)) return;
  }
  throw InvalidParameter(
      what + " is of the scheme '" + scheme.name + "', but the level that it meets was made by " +
      (other.name == scheme.name ? "a scheme of this name with other masks or ends" : "'" + other.name + "'") +
      "; take one scheme for both");
}

SparseMatrix refinement_matrix(const std::vector<CurveLevel>& levels) {
  SparseMatrix P = levels.front().S;
  for (size_t k = 1; k < levels.size(); ++k) product(levels[k].S, P).swap(P);
  return P;
}

Points unknowns(const CurveScheme<double>& scheme, const ControlPolygon& polygon) {
  if (scheme.masks.unknowns() == 1) return polygon.points;
  if (!polygon.has_tangents())
    throw InvalidMesh("the points have no derivatives; " + scheme.name +
                      " takes both, as columns x,y,dx,dy or x,y,z,dx,dy,dz of a .csv");
  Points stacked(2 * polygon.num_points(), polygon.dimension());
  for (Index i = 0; i < polygon.num_points(); ++i) {
    stacked.row(2 * i) = polygon.points.row(i);
    stacked.row(2 * i + 1) = polygon.tangents.row(i);
  }
  return stacked;
}

ControlPolygon curve_outlines(const CurveLevel& level) {
  ControlPolygon polygon;
  Index start = 0;
  for (const CurveOutline& outline : level.curves) {
    ControlPolygon::Curve& curve = polygon.curves.emplace_back();
    curve.closed = outline.closed;
    curve.points.resize(outline.size);
    std::iota(curve.points.begin(), curve.points.end(), start);
    start += outline.size;
  }
  return polygon;
}

ControlPolygon refined_polygon(const CurveLevel& level, const Points& unknowns) {
  ControlPolygon polygon = curve_outlines(level);
  if (level.unknowns == 1) {
    polygon.points = unknowns;
  } else {
    polygon.points = unknowns(Eigen::seq(0, Eigen::last, 2), Eigen::all);
    polygon.tangents = unknowns(Eigen::seq(1, Eigen::last, 2), Eigen::all);
  }
  return polygon;
}

}  // namespace sublimit

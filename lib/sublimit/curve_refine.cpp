// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curve_refine.h"

#include <cmath>
#include <numeric>

#include "sublimit/sparse_product.h"

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
  const double points = std::ldexp(result[0].num_points(), levels);
  if (points * 8 > std::numeric_limits<Index>::max())
    throw ResourceError(std::to_string(levels) + " levels of " + std::to_string(result[0].num_points()) +
                        " points are more points than 32-bit indices can hold the weights of; use fewer levels");
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    result.push_back(next_level(scheme, result.back()));
  }
  return result;
}

SparseMatrix refinement_matrix(const std::vector<CurveLevel>& levels) {
  SparseMatrix P = levels.front().S;
  for (size_t k = 1; k < levels.size(); ++k) product(levels[k].S, P).swap(P);
  return P;
}

ControlPolygon refined_polygon(const CurveLevel& level, const Points& points) {
  ControlPolygon polygon;
  polygon.points = points;
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

}  // namespace sublimit

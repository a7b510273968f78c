// SPDX-License-Identifier: Apache-2.0
#include "laws/point_limits.h"

#include <algorithm>
#include <cmath>

namespace sublimit::testing {
namespace {

/// Whether a place with one-sided derivatives is inside its curve: a corner, not an end.
bool is_corner(const LimitCurve& curve, const std::vector<CurveOutline>& outlines, const CurvePlace& place) {
  const std::vector<CurvePlace> points = curve.point_places();
  size_t start = 0;
  for (Index c = 0; c < curve.num_curves(); ++c) {
    const size_t end = start + size_t(outlines[size_t(c)].size) - 1;
    const bool is_on = c + 1 == curve.num_curves() || place.segment < curve.first_segment(c + 1);
    if (is_on && outlines[size_t(c)].closed) return true;
    if (is_on)
      return curve.parameter(place) != curve.parameter(points[start]) &&
             curve.parameter(place) != curve.parameter(points[end]);
    start = end + 1;
  }
  return true;
}

}  // namespace

CurvePlace place_at(const CurveLayout& layout, const CurveOutline& curve, std::int64_t position) {
  const Index segments = curve.size - (curve.closed ? 0 : 1);
  if (curve.closed)
    position = curve.first + (position - curve.first + 4 * std::int64_t{curve.size}) % (2 * std::int64_t{curve.size});
  else
    position = std::clamp<std::int64_t>(position, 0, layout.end(curve));
  Index segment = 0;
  const auto end = [&](Index s) {
    return curve.closed ? layout.position(curve, s) + 2 : layout.position(curve, s + 1);
  };
  while (segment + 1 < segments && end(segment) <= position) ++segment;
  const std::int64_t from = layout.position(curve, segment);
  return {segment, double(position - from) / double(end(segment) - from)};
}

PointLimits limits_at(const CurveScheme<double>& scheme, const CurveLevel& level,
                      const std::vector<CurvePlace>& places) {
  const LimitCurve curve(scheme, level);
  const PlaceStencils found = place_stencils(curve, places, 2);
  PointLimits all{found.matrices[0],
                  found.matrices[1] * std::ldexp(1.0, level.number),
                  found.matrices[2] * std::ldexp(1.0, 2 * level.number),
                  {}};
  for (size_t i = 0; i < places.size(); ++i) {
    const bool corner = found.status[i] == LimitStatus::crease && is_corner(curve, level.curves, places[i]);
    all.order.push_back(corner ? 0 : static_cast<int>(curve.stencil(places[i], 2).weights.rows()) - 1);
  }
  return all;
}

PointLimits point_limits(const CurveScheme<double>& scheme, const CurveLevel& level) {
  return limits_at(scheme, level, LimitCurve(scheme, level).point_places());
}

}  // namespace sublimit::testing

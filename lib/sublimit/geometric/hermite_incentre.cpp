// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/hermite_incentre.h"

#include <array>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/geometric/hermite_polygon.h"
#include "sublimit/geometric/incentre_input.h"

namespace sublimit {
namespace {

double scale_of(const ControlPolygon& polygon) { return polygon.points.cwiseAbs().maxCoeff(); }

ControlPolygon refined(const ControlPolygon& polygon) {
  const double scale = scale_of(polygon);
  return with_points_on_segments(polygon, 2, [&](size_t c, Index i, Index j) {
    const std::vector<Index>& points = polygon.curves[c].points;
    const HermitePoint a = hermite_point(polygon, points[i]);
    return j == 0 ? a : incentre_step(a, hermite_point(polygon, points[(i + 1) % points.size()]), scale).point;
  });
}

ControlPolygon points_on_biarcs(const ControlPolygon& polygon, int levels) {
  if (levels < 0) throw InvalidParameter("levels is " + format_number(levels) + "; it must be 0 or more");
  if (levels > 30) throw ResourceError(format_number(levels) + " levels are more points than 32-bit indices count");
  const std::vector<std::vector<SegmentLimit>> limit = incentre_limit(polygon);
  return with_points_on_segments(polygon, Index{1} << levels,
                                 [&](size_t c, Index i, Index j) { return limit[c][i].at(std::ldexp(j, -levels)); });
}

std::vector<std::string> notes(const ControlPolygon& polygon) {
  std::array<Index, 5> count{};
  Index segments = 0;
  const double scale = scale_of(polygon);
  for (const ControlPolygon::Curve& curve : polygon.curves)
    for_each_segment(polygon, curve, [&](const HermitePoint& a, const HermitePoint& b) {
      ++count[static_cast<size_t>(incentre_step(a, b, scale).kind)];
      ++segments;
    });
  const auto of = [&](SegmentKind kind) { return count[static_cast<size_t>(kind)]; };
  const Index fell_back = of(SegmentKind::inflection) + of(SegmentKind::twisted) + of(SegmentKind::back);
  if (fell_back == 0) return {};
  std::string which;
  const auto add = [&](SegmentKind kind, const char* words) {
    if (of(kind) > 0) which += (which.empty() ? "" : ", ") + format_number(of(kind)) + " " + words;
  };
  add(SegmentKind::inflection, "with angles on different sides or of zero");
  add(SegmentKind::twisted, "with tangents out of the plane");
  add(SegmentKind::back, "halved first, with both tangents pointing back");
  return {format_number(fell_back) + " of " + format_number(segments) +
          " segments have no incentre and become biarcs of equal chords (" + which + ")"};
}

}  // namespace

std::vector<std::vector<SegmentLimit>> incentre_limit(const ControlPolygon& polygon) {
  const double scale = scale_of(polygon);
  std::vector<std::vector<SegmentLimit>> result(polygon.curves.size());
  for (size_t c = 0; c < polygon.curves.size(); ++c)
    for_each_segment(polygon, polygon.curves[c], [&](const HermitePoint& a, const HermitePoint& b) {
      result[c].push_back(incentre_segment(a, b, scale));
    });
  return result;
}

namespace {

std::vector<std::vector<SegmentCurve>> segments(const ControlPolygon& polygon) {
  std::vector<std::vector<SegmentCurve>> result;
  for (const std::vector<SegmentLimit>& curve : incentre_limit(polygon)) {
    std::vector<SegmentCurve>& one = result.emplace_back();
    for (const SegmentLimit& limit : curve)
      one.push_back([limit](double t, bool before) { return limit.place(t, before); });
  }
  return result;
}

}  // namespace

GeometricCurveScheme hermite_incentre(const SchemeOptions&) {
  return {.name = "hermite-incentre",
          .source = "incentre of segment and tangents, new tangent along the segment (unlike Deng, Wang 2010)",
          .checked = checked_for_incentres,
          .refine = refined,
          .limit = points_on_biarcs,
          .segments = segments,
          .notes = notes,
          .claims = {.regular = 1,
                     .interpolates = true,
                     .reproduces = "circles",
                     .limit = "biarcs through the incentres",
                     .exponent = "2"}};
}

}  // namespace sublimit

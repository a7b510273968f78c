// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/spline_curve.h"

#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {

CurvePlace SplineCurve::place(double t, KnotSide side) const {
  const KnotPlace<double> place = knots_.place(t, side);
  return {place.face, place.u};
}

CurveStencil SplineCurve::stencil(const CurvePlace& place, int order) const {
  check_order(order);
  check_place(place, num_segments());
  PointRows rows = point_rows(knots_, {place.segment, place.t}, order);
  return {.status = rows.sides_differ ? LimitStatus::crease : LimitStatus::regular,
          .unknowns = std::move(rows.points),
          .weights = std::move(rows.weights)};
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/lagrange_surface.h"

#include <limits>
#include <numeric>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/lagrange_curve.h"
#include "sublimit/patches/constructions/tensor_rows.h"

namespace sublimit {

LagrangeSurface::LagrangeSurface(LagrangeBasis u, LagrangeBasis v) : u_(std::move(u)), v_(std::move(v)) {
  if (std::int64_t{u_.size()} * v_.size() > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(u_.size()) + " x " + format_number(v_.size()) +
                        " points are more than 32-bit indices count");
}

std::vector<Index> LagrangeSurface::slots(Index) const {
  std::vector<Index> points(static_cast<size_t>(num_points()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

LimitStatus LagrangeSurface::rows(const Place& place, int order, WeightRows& weights) const {
  tensor_rows(u_.rows(place.u, order), v_.rows(place.v, order), order, weights);
  return LimitStatus::regular;
}

std::string LagrangeSurface::type(Index) const {
  std::string bytes = "lagrange";
  append_bytes(bytes, u_.nodes());
  append_bytes(bytes, v_.nodes());
  return bytes;
}

Place LagrangeSurface::place(const Parameters& parameters) const {
  u_.check_inside(parameters.u);
  v_.check_inside(parameters.v);
  return {.face = 0, .u = u_.unit(parameters.u), .v = v_.unit(parameters.v)};
}

Patch::Parameters LagrangeSurface::parameters(const Place& place) const {
  return {.u = u_.begin() + place.u * u_.length(), .v = v_.begin() + place.v * v_.length()};
}

std::optional<Patch::BezierRows> LagrangeSurface::bezier(Index) const {
  const std::optional<Points> u = lagrange_to_bezier(u_), v = lagrange_to_bezier(v_);
  if (!u || !v) return std::nullopt;
  return BezierRows{static_cast<int>(u_.size()) - 1, static_cast<int>(v_.size()) - 1, outer_product(*v, *u)};
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/screw_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/tensor_rows.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

/// Rows of an angle over O, P, Q, E.
WeightRows angle_rows(double u, double length, int order) {
  const double c = std::cos(u), s = std::sin(u);
  WeightRows rows(order + 1, 4);
  rows.row(0) << 1 - c - s - u, c, s, u;
  if (order >= 1) rows.row(1) << length * (s - c - 1), -length * s, length * c, length;
  if (order >= 2) rows.row(2) << length * length * (c + s), -length * length * c, -length * length * s, 0;
  return rows;
}

/// Rows of a place over the p + 1 basis functions of its span.
WeightRows function_rows(const Knots<double>& knots, const KnotPlace<double>& place, int order) {
  WeightRows rows(order + 1, knots.degree() + 1);
  span_rows(knots, place.face, place.u, order, std::span<double>(rows.data(), size_t(rows.size())));
  return rows;
}

}  // namespace

ScrewSurface::ScrewSurface(Knots<double> v, double from, double to) : v_(std::move(v)), from_(from), to_(to), arcs_(0) {
  constexpr double quarter = std::numbers::pi / 2, most = 4e5 * quarter;
  if (!(std::isfinite(from) && std::isfinite(to) && from < to))
    throw InvalidParameter("u from " + format_number(from) + " to " + format_number(to) +
                           ": two finite angles in radians, the second greater");
  if (!(to - from <= most))
    throw InvalidParameter("u from " + format_number(from) + " to " + format_number(to) +
                           ": at most 100000 turns are taken");
  // Whole quarters are one arc each, whatever the last bit of pi.
  arcs_ = std::max<Index>(1, static_cast<Index>(std::ceil((to - from) / quarter * (1 - 1e-12))));
}

Points ScrewSurface::columns(const CurveNet& curve, double pitch) const {
  check_space_curve(curve, "curve");
  if (curve.knots.num_points() != v_.num_points()) throw InvalidParameter("curve: it has other knots than the surface");
  if (!std::isfinite(pitch)) throw InvalidParameter("a pitch of " + format_number(pitch) + ": it must be finite");
  const double rise = pitch / (2 * std::numbers::pi);
  const bool rational = curve.coordinates == Coordinates::homogeneous;
  Points result(Eigen::Index{num_points()}, curve.columns.cols());
  for (Index i = 0; i < v_.num_points(); ++i) {
    const Eigen::RowVectorXd P = curve.columns.row(i);
    const double w = rational ? P[3] : 1;
    Eigen::RowVectorXd O = P, Q = P, E = P;
    O[0] = O[1] = E[0] = E[1] = 0;
    Q[0] = -P[1], Q[1] = P[0];
    E[2] += w * rise;
    result.middleRows<4>(4 * Eigen::Index{i}) << O, P, Q, E;
  }
  return result;
}

std::vector<Index> ScrewSurface::slots(Index face) const {
  const Index first = v_.span(face / arcs_) - v_.degree();
  std::vector<Index> points;
  for (Index j = first; j <= first + v_.degree(); ++j)
    for (Index k = 0; k < 4; ++k) points.push_back(4 * v_.point(j) + k);
  return points;
}

double ScrewSurface::angle(Index arc, double u) const {
  if (arc == arcs_ - 1 && u == 1) return to_;
  return from_ + (to_ - from_) * ((arc + u) / arcs_);
}

LimitStatus ScrewSurface::rows(const Place& place, int order, WeightRows& weights) const {
  const Index arc = place.face % arcs_;
  const KnotPlace<double> in_v{place.face / arcs_, place.v};
  tensor_rows(angle_rows(angle(arc, place.u), (to_ - from_) / arcs_, order), function_rows(v_, in_v, order), order,
              weights);
  return sides_differ(v_, in_v, order) ? LimitStatus::crease : LimitStatus::regular;
}

std::string ScrewSurface::type(Index face) const {
  std::string bytes = "screw";
  const Index arc = face % arcs_;
  const std::array<double, 3> in_u{angle(arc, 0), angle(arc, 1), double(v_.degree())};
  append_bytes(bytes, in_u);
  append_bytes(bytes, v_.type(face / arcs_));
  return bytes;
}

Place ScrewSurface::place(const Parameters& parameters) const {
  if (!(parameters.u >= from_ && parameters.u <= to_)) refuse_parameter(parameters.u, from_, to_);
  const KnotPlace<double> in_v = v_.place(parameters.v, parameters.v_side);
  const double all = (parameters.u - from_) / (to_ - from_) * arcs_;
  Index arc = std::min(arcs_ - 1, static_cast<Index>(all));
  if (parameters.u_side == KnotSide::left && arc > 0 && all == arc) --arc;
  return {.face = arc + arcs_ * in_v.face, .u = std::min(1.0, all - arc), .v = in_v.u};
}

Patch::Parameters ScrewSurface::parameters(const Place& place) const {
  return {.u = angle(place.face % arcs_, place.u), .v = v_.parameter({place.face / arcs_, place.v})};
}

Patch::Lengths ScrewSurface::lengths(Index face) const { return {(to_ - from_) / arcs_, v_.length(face / arcs_)}; }

}  // namespace sublimit

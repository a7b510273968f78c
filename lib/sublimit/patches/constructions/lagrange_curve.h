// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial curves through points at nodes (lagrange_basis.h): one segment, whose rows are over all points.
#include <optional>

#include "sublimit/patches/constructions/lagrange_basis.h"
#include "sublimit/patches/constructions/spline_net.h"
#include "sublimit/patches/linear_curve.h"

namespace sublimit {

/// A curve in a Lagrange basis.
class LagrangeCurve : public LinearCurve {
 public:
  explicit LagrangeCurve(LagrangeBasis basis) : basis_(std::move(basis)) {}

  const LagrangeBasis& basis() const { return basis_; }
  Index num_segments() const override { return 1; }
  Index num_points() const override { return basis_.size(); }
  CurvePlace place(double t, KnotSide side = KnotSide::right) const override;
  double length(Index) const override { return basis_.length(); }
  CurveStencil stencil(const CurvePlace& place, int order = 0) const override;

 private:
  LagrangeBasis basis_;
};

/// Largest error of conversions to Bezier form, relative to the size of the points.
inline constexpr double lagrange_net_accuracy = 1e-12;

/// Returns the matrix from points at the nodes to Bezier points. Nothing if its error, measured between the
/// nodes, exceeds `lagrange_net_accuracy`, or the degree exceeds max_degree.
std::optional<Points> lagrange_to_bezier(const LagrangeBasis& basis);
/// Returns the polynomial as a Bezier curve over the nodes' domain, if its basis has that form.
std::optional<CurveNet> lagrange_net(const LagrangeBasis& basis, const Points& points);
/// Returns the polynomial as a Bezier surface over the nodes' domain, if its basis has that form.
std::optional<SplineNet> lagrange_net(const LagrangeBasis& u, const LagrangeBasis& v, const Points& points);

}  // namespace sublimit

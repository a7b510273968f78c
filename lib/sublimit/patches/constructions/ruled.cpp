// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/ruled.h"

#include <utility>

#include "sublimit/patches/constructions/common_space.h"

namespace sublimit {
namespace {

SplineNet between_rows(const Knots<double>& u, const Points& from, const Points& to, Coordinates coordinates) {
  Points columns(from.rows() + to.rows(), from.cols());
  columns << from, to;
  return spline_net(u, bezier_knots<double>(1), std::move(columns), coordinates);
}

/// Weights of control points.
Eigen::VectorXd weights_of(const CurveNet& curve) {
  if (curve.coordinates == Coordinates::homogeneous) return curve.columns.col(3);
  return Eigen::VectorXd::Ones(curve.columns.rows());
}

}  // namespace

SplineNet ruled(CurveNet c0, CurveNet c1) {
  check_space_curve(c0, "c0");
  check_space_curve(c1, "c1");
  CurveNet* const both[] = {&c0, &c1};
  const Coordinates coordinates = make_compatible(both);
  return between_rows(c0.knots, c0.columns, c1.columns, coordinates);
}

SplineNet bilinear_patch(const Points& corners) {
  return spline_net(bezier_knots<double>(1), bezier_knots<double>(1), corners);
}

SplineNet extrusion(const CurveNet& curve, const Eigen::RowVector3d& direction) {
  check_space_curve(curve, "curve");
  Points moved = curve.columns;
  moved.leftCols(3) += weights_of(curve) * direction;
  return between_rows(curve.knots, curve.columns, moved, curve.coordinates);
}

SplineNet cone(const CurveNet& curve, const Eigen::RowVector3d& apex) {
  check_space_curve(curve, "curve");
  Points tip = curve.columns;
  tip.leftCols(3) = weights_of(curve) * apex;  // the weights stay, so that lines of constant u are straight
  return between_rows(curve.knots, curve.columns, tip, curve.coordinates);
}

}  // namespace sublimit

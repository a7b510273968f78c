// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/spline_net.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {

SplineNet spline_net(const Knots<double>& u, const Knots<double>& v, Points columns, Coordinates coordinates) {
  auto surface = std::make_shared<const SplineSurface>(u, v);
  check_columns(columns, surface->num_points(), coordinates);
  return {std::move(surface), std::move(columns), coordinates};
}

SplineNet built(const NetBuilder& builder, const Points& data, Coordinates coordinates) {
  Points columns = apply(builder.M, data);
  check_columns(columns, builder.surface->num_points(), coordinates);
  return {builder.surface, std::move(columns), coordinates};
}

void check_space_curve(const CurveNet& curve, const std::string& name) {
  try {
    check_columns(curve.columns, curve.knots.num_points(), curve.coordinates);
  } catch (const InvalidParameter& error) {
    throw InvalidParameter(name + ": " + error.what());
  }
  if (!curve.columns.allFinite()) throw InvalidParameter(name + ": control points must be finite numbers");
}

CurveNet homogeneous(CurveNet curve) {
  if (curve.coordinates == Coordinates::homogeneous) return curve;
  curve.columns.conservativeResize(Eigen::NoChange, curve.columns.cols() + 1);
  curve.columns.rightCols(1).setOnes();
  curve.coordinates = Coordinates::homogeneous;
  return curve;
}

Coordinates make_alike(std::span<CurveNet* const> curves) {
  const bool rational =
      std::ranges::any_of(curves, [](const CurveNet* c) { return c->coordinates == Coordinates::homogeneous; });
  if (!rational) return Coordinates::plain;
  for (CurveNet* const curve : curves) *curve = homogeneous(std::move(*curve));
  return Coordinates::homogeneous;
}

Eigen::RowVectorXd column_at(const CurveNet& curve, double t, int order) {
  const KnotPlace<double> place = curve.knots.place(t);
  const PointRows rows = point_rows(curve.knots, place, order);
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(curve.columns.cols());
  for (size_t i = 0; i < rows.points.size(); ++i)
    sum += rows.weights(order, Eigen::Index(i)) * curve.columns.row(rows.points[i]);
  return sum / std::pow(curve.knots.length(place.face), order);
}

double extent(std::span<const Points* const> parts) {
  Eigen::RowVectorXd low, high;
  for (const Points* const part : parts) {
    if (part->rows() == 0) continue;
    const Eigen::RowVectorXd least = part->colwise().minCoeff(), most = part->colwise().maxCoeff();
    low = low.size() == 0 ? least : Eigen::RowVectorXd(low.cwiseMin(least));
    high = high.size() == 0 ? most : Eigen::RowVectorXd(high.cwiseMax(most));
  }
  return low.size() == 0 ? 0 : (high - low).maxCoeff();
}

std::string in_words(const Eigen::RowVectorXd& point) {
  std::string text;
  for (Eigen::Index i = 0; i < point.size(); ++i) text += (i == 0 ? "(" : ", ") + format_number(point[i]);
  return text + ")";
}

}  // namespace sublimit

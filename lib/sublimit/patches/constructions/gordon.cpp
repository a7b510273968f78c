// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/gordon.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/constructions/boolean_sum.h"
#include "sublimit/patches/constructions/common_space.h"
#include "sublimit/patches/constructions/interpolation.h"

namespace sublimit {
namespace {

/// Functions that are 1 at one parameter and 0 at the others, as splines.
CurveNet cardinal_functions(GordonBlending blending, std::span<const double> parameters, double begin, double end,
                            const char* name) {
  const int count = static_cast<int>(parameters.size());
  const int degree = blending == GordonBlending::lagrange ? count - 1 : std::min(3, count - 1);
  try {
    const Knots<double> knots = averaged_knots(degree, parameters, begin, end);
    return {knots, interpolating_points(knots, parameters, Points::Identity(count, count))};
  } catch (const InvalidParameter& error) {
    throw InvalidParameter(std::string(name) + ": " + error.what());
  }
}

Knots<double> family_knots(std::vector<CurveNet>& curves, const char* name) {
  if (curves.empty()) throw InvalidParameter(std::string(name) + ": no curves; a network needs one at least each way");
  std::vector<CurveNet*> all;
  for (size_t i = 0; i < curves.size(); ++i) {
    const std::string one = std::string(name) + "[" + format_number(i) + "]";
    check_space_curve(curves[i], one);
    if (curves[i].coordinates == Coordinates::homogeneous)
      throw InvalidParameter(one + " is rational: Gordon surfaces are of curves that are not");
    all.push_back(&curves[i]);
  }
  try {
    make_compatible(all);
  } catch (const InvalidParameter& error) {
    throw InvalidParameter(std::string(name) + ": " + error.what());
  }
  return curves[0].knots;
}

void check_parameters(const std::vector<double>& parameters, size_t curves, const Knots<double>& knots,
                      const char* name, const char* of) {
  if (parameters.size() != curves)
    throw InvalidParameter(format_number(parameters.size()) + " " + name + " for " + format_number(curves) + " " + of +
                           ": one is needed for each");
  for (size_t i = 0; i < parameters.size(); ++i)
    if (!(parameters[i] >= knots.begin() && parameters[i] <= knots.end()))
      throw InvalidParameter(std::string(name) + "[" + format_number(i) + "] is " + format_number(parameters[i]) +
                             ", outside the domain of the curves, " + format_number(knots.begin()) + " to " +
                             format_number(knots.end()));
}

struct NetworkGap {
  double distance = 0;
  size_t u = 0, v = 0;
};
NetworkGap largest_gap(const GordonNetwork& network) {
  NetworkGap worst;
  for (size_t l = 0; l < network.curves_u.size(); ++l)
    for (size_t k = 0; k < network.curves_v.size(); ++k) {
      const double distance = (column_at(network.curves_u[l], network.parameters_u[k]) -
                               column_at(network.curves_v[k], network.parameters_v[l]))
                                  .norm();
      if (!(distance <= worst.distance)) worst = {distance, l, k};
    }
  return worst;
}

std::vector<Eigen::RowVectorXd> point_rows_of(const Points& points) {
  std::vector<Eigen::RowVectorXd> rows;
  for (Eigen::Index i = 0; i < points.rows(); ++i) rows.emplace_back(points.row(i));
  return rows;
}

}  // namespace

double network_gap(const GordonNetwork& network) { return largest_gap(network).distance; }

SplineNet gordon(const GordonNetwork& given, GordonBlending blending, double tolerance) {
  GordonNetwork network = given;
  const Knots<double> along_u = family_knots(network.curves_u, "curves_u"),
                      along_v = family_knots(network.curves_v, "curves_v");
  const auto &at_u = network.parameters_u, &at_v = network.parameters_v;
  check_parameters(at_u, network.curves_v.size(), along_u, "parameters_u", "curves_v");
  check_parameters(at_v, network.curves_u.size(), along_v, "parameters_v", "curves_u");
  if (tolerance < 0) {
    std::vector<const Points*> parts;
    for (const CurveNet& curve : network.curves_u) parts.push_back(&curve.columns);
    tolerance = 1e-9 * extent(parts);
  }
  if (const NetworkGap gap = largest_gap(network); !(gap.distance <= tolerance))
    throw InvalidMesh("curves_u[" + format_number(gap.u) + "] and curves_v[" + format_number(gap.v) + "] are " +
                      format_number(gap.distance) + " apart at (" + format_number(at_u[gap.v]) + ", " +
                      format_number(at_v[gap.u]) + "), more than the tolerance " + format_number(tolerance) +
                      "; they must meet there");
  const CurveNet phi = cardinal_functions(blending, at_u, along_u.begin(), along_u.end(), "parameters_u"),
                 psi = cardinal_functions(blending, at_v, along_v.begin(), along_v.end(), "parameters_v");
  const Knots<double> u = common_knots(std::vector{along_u, phi.knots}),
                      v = common_knots(std::vector{along_v, psi.knots});
  BooleanSum<Eigen::RowVectorXd> sum;
  sum.phi = in_space(phi, u).columns, sum.psi = in_space(psi, v).columns;
  sum.Q.resize(at_u.size());
  for (const CurveNet& curve : network.curves_u) {
    sum.C.push_back(point_rows_of(in_space(curve, u).columns));
    for (size_t k = 0; k < at_u.size(); ++k) sum.Q[k].push_back(column_at(curve, at_u[k]));
  }
  for (const CurveNet& curve : network.curves_v) sum.D.push_back(point_rows_of(in_space(curve, v).columns));
  const Index m = u.num_points(), n = v.num_points();
  Points columns(Eigen::Index{m} * n, 3);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) columns.row(Eigen::Index{j} * m + i) = sum.at(i, j);
  return spline_net(u, v, std::move(columns));
}

}  // namespace sublimit

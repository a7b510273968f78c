// SPDX-License-Identifier: Apache-2.0
// Gordon surfaces have the curves of their network.
#include "sublimit/patches/constructions/gordon.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// Curves of constant u and v of a random surface.
GordonNetwork network_on(const SplineNet& net, std::vector<double> at_u, std::vector<double> at_v) {
  GordonNetwork network{{}, {}, at_u, at_v};
  const Knots<double>&u = net.surface->u(), &v = net.surface->v();
  const Index m = u.num_points(), n = v.num_points();
  for (const double t : at_v) {
    Points points(m, 3);
    for (Index i = 0; i < m; ++i) points.row(i) = truth({v, net.columns(Eigen::seqN(i, n, m), Eigen::all)}, t);
    network.curves_u.push_back({u, points});
  }
  for (const double t : at_u) {
    Points points(n, 3);
    for (Index j = 0; j < n; ++j) points.row(j) = truth({u, net.columns.middleRows(j * m, m)}, t);
    network.curves_v.push_back({v, points});
  }
  return network;
}

TEST(Gordon, HasItsCurves) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 6; ++repeat) {
    const Knots<double> u = unit_knots(random, 3), v = unit_knots(random, 2);
    const SplineNet net = spline_net(u, v, random_points(random, u.num_points() * v.num_points(), 3));
    const GordonNetwork network = network_on(net, {0, 0.2, 0.5, 0.8, 1}, {0, 0.4, 1});
    for (const GordonBlending blending : {GordonBlending::lagrange, GordonBlending::spline}) {
      const SplineNet surface = gordon(network, blending);
      for (const double t : {0.0, 0.1, 0.33, 0.7, 1.0}) {
        for (size_t l = 0; l < 3; ++l)
          expect_near(own_values(surface, t, network.parameters_v[l]).x.row(0), truth(network.curves_u[l], t),
                      100 * sums);
        for (size_t k = 0; k < 5; ++k)
          expect_near(own_values(surface, network.parameters_u[k], t).x.row(0), truth(network.curves_v[k], t),
                      100 * sums);
      }
    }
  }
}

TEST(Gordon, ReproducesWhatItsBlendingFunctionsDo) {
  std::mt19937 random(2);
  // Of degree 2 in u and 1 in v: Lagrange blending through 3 and 2 curves has it.
  const SplineNet net = spline_net(bezier_knots<double>(2), bezier_knots<double>(1), random_points(random, 6, 3));
  const SplineNet surface = gordon(network_on(net, {0.1, 0.5, 0.9}, {0.25, 1}), GordonBlending::lagrange);
  expect_near(surface.columns, net.columns, 10 * sums);
}

TEST(Gordon, NamesCurvesThatDoNotMeet) {
  std::mt19937 random(3);
  const SplineNet net = spline_net(bezier_knots<double>(2), bezier_knots<double>(2), random_points(random, 9, 3));
  const GordonNetwork network = network_on(net, {0, 1}, {0, 0.5, 1});
  GordonNetwork apart = network;
  apart.curves_v[1].columns.row(0)[0] += 0.5;
  expect_error<InvalidMesh>([&] { gordon(apart, GordonBlending::spline); },
                            {"curves_u[0] and curves_v[1] are 0.5 apart at (1, 0)"});
  EXPECT_NEAR(network_gap(apart), 0.5, sums);
  GordonNetwork outside = network;
  outside.parameters_u[1] = 1.5;
  expect_error<InvalidParameter>([&] { gordon(outside, GordonBlending::spline); },
                                 {"parameters_u[1] is 1.5, outside the domain of the curves, 0 to 1"});
  outside.parameters_u = {0};
  expect_error<InvalidParameter>([&] { gordon(outside, GordonBlending::spline); }, {"1 parameters_u for 2 curves_v"});
  GordonNetwork equal = network;
  equal.parameters_v = {0, 0, 1};
  equal.curves_u[1] = equal.curves_u[0];
  expect_error<InvalidParameter>([&] { gordon(equal, GordonBlending::lagrange); }, {"parameters 0 and 1 are both 0"});
  expect_error<InvalidParameter>([&] { gordon({}, GordonBlending::spline); }, {"curves_u: no curves"});
}

}  // namespace
}  // namespace sublimit::testing

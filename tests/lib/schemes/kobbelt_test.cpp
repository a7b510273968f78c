// SPDX-License-Identifier: Apache-2.0
// Kobbelt 1996: the spectrum of two rings by hand, tangents of the regular vertex.
#include "sublimit/schemes/kobbelt.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

// Two rings, in each sector (x along its edge, y along the next): the neighbour, the diagonal, and five at distance 2.
enum Place { e10, f11, e20, f21, f12, f22 };

/// The four-point rule in both directions; r is the weight of the diagonals in the virtual point.
HandBlock two_rings(int n, int k, double g, double r) {
  HandBlock block(n, k, 6);
  const double a = (8 + g) / 16, b = g / 16;
  // Rows of the points that are on edges, as weights times `scale` in another row and sector.
  const auto on_spoke = [&](int row, int sector, double scale) {
    block.add(row, e10, sector, scale * a);
    block.add(row, e20, sector, -scale * b);
    const double virtual_point = -scale * b;
    for (int j = 0; j < n; ++j) {
      block.add(row, e10, j, virtual_point * 4 / n);
      block.add(row, f11, j, -virtual_point * 4 * r / n);
    }
    for (const int j : {-1, 0, 1}) block.add(row, e10, sector + j, -virtual_point);
    for (const int j : {-2, -1, 0, 1}) block.add(row, f11, sector + j, virtual_point * r);
  };
  const auto at_21 = [&](int row, int sector, double scale) {  // on the line x = 1
    block.add(row, e10, sector, scale * a);
    block.add(row, f11, sector, scale * a);
    block.add(row, f11, sector - 1, -scale * b);
    block.add(row, f12, sector, -scale * b);
  };
  const auto at_12 = [&](int row, int sector, double scale) {  // on the line y = 1
    block.add(row, e10, sector + 1, scale * a);
    block.add(row, f11, sector, scale * a);
    block.add(row, f11, sector + 1, -scale * b);
    block.add(row, f21, sector, -scale * b);
  };
  on_spoke(e10, 0, 1);
  block.add(e20, e10, 0, 1);
  block.add(f22, f11, 0, 1);
  at_21(f21, 0, 1);
  at_12(f12, 0, 1);
  // The face point, from the new points (1, -2), (1, 0), (1, 2), (1, 4) of this sector.
  at_21(f11, -1, -b);
  on_spoke(f11, 0, a);
  at_12(f11, 0, a);
  block.add(f11, e20, 1, -b * a);
  block.add(f11, f12, 0, -b * a);
  block.add(f11, f21, 1, b * b);
  block.add(f11, f22, 0, b * b);
  return block;
}

TEST(Kobbelt, SpectrumOfTwoRingsIsTheOneByHand) {
  const std::pair<const char*, double> tensions[] = {{"1", 1}, {"1/2", 0.5}, {"2", 2}};
  for (const auto& [text, g] : tensions)
    for (int n = 3; n <= 20; ++n) {
      const LocalSpectrum rings("kobbelt", n, -1, {{"tension", text}});
      for (int k = 0; k < n; ++k) expect_same_spectrum(rings, k, two_rings(n, k, g, g / (8 + g)));
    }
}

TEST(Kobbelt, LambdaIsAsTabulated) {
  expect_table("kobbelt",
               {.42633091, .5, .53794386, .55968452, .57319704, .58213430, .58833903, .59281631, .59615014, .59869791});
}

TEST(Kobbelt, CurvatureRatiosAreAsTabulated) {
  const std::pair<int, double> table[] = {{3, 1.375}, {4, 1},     {5, 1.251}, {6, 1.361},
                                          {7, 1.430}, {8, 1.475}, {12, 1.561}};
  for (const auto& [n, expected] : table) {
    const LocalSpectrum rings("kobbelt", n, 2);
    const double lambda = rings.leading(1);
    EXPECT_NEAR(rings.largest_below(lambda) / (lambda * lambda), expected, three_decimals) << n;
  }
}

TEST(Kobbelt, LimitIsTheVertexWithATangentPlane) {
  for (int n = 3; n <= 20; ++n) {
    const LimitMasks masks = isolated_centre("kobbelt", n).masks;
    EXPECT_LE((masks.position - Eigen::VectorXd::Unit(masks.position.size(), 0)).norm(), closed_form) << n;
    EXPECT_NEAR(masks.sides.at(0).lambda1, LocalSpectrum("kobbelt", n).leading(1), closed_form) << n;
    EXPECT_EQ(masks.sides.at(0).plane, LimitMasks::Plane::yes) << n;
  }
}

// The derivative of the four-point rule, 8 (v_1 - v_-1) - g (v_2 - v_-2), in both directions.
TEST(Kobbelt, RegularTangentsAreTheFourPointDerivative) {
  const int width = 11, centre = 5 * width + 5;
  for (const auto& [text, g] : {std::pair{"1", 1.0}, std::pair{"1/2", 0.5}}) {
    const Scheme<double> scheme = find_scheme("kobbelt", {{"tension", text}}).value();
    const Level level = control_level(scheme, grid(width - 1, width - 1));
    LimitCache cache(scheme);
    const LimitMatrices limit = limit_matrices(level, cache);
    Eigen::VectorXd along = Eigen::VectorXd::Zero(width * width), across = along;
    for (const int sign : {-1, 1}) {
      along[centre + sign] = across[centre + sign * width] = 8 * sign;
      along[centre + 2 * sign] = across[centre + 2 * sign * width] = -g * sign;
    }
    const auto side =
        std::lower_bound(limit.side_vertex.begin(), limit.side_vertex.end(), centre) - limit.side_vertex.begin();
    expect_tangents(limit.tangent1.row(side).transpose(), limit.tangent2.row(side).transpose(), along, across);
  }
}

}  // namespace
}  // namespace sublimit::testing

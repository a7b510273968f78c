// SPDX-License-Identifier: Apache-2.0
// Dyn, Levin, Gregory 1990: spectra by hand, the valences that fail (Zorin 1997), tangents of the regular vertex.
#include "sublimit/schemes/butterfly.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

// Two rings, in each sector: v, the neighbour; d, the next point on its line; m, between v and the next v.
enum Place { v, d, m };

HandBlock two_rings(int n, int k, double w) {
  HandBlock block(n, k, 3);
  // On the edge to v, whose butterfly has its far wings in the two m beside v.
  block.add(v, v, 0, 0.5);
  block.add(v, v, 1, 2 * w);
  block.add(v, v, -1, 2 * w);
  block.add(v, v, 2, -w);
  block.add(v, v, -2, -w);
  block.add(v, m, 0, -w);
  block.add(v, m, -1, -w);
  block.add(d, v, 0, 1);
  // On the edge from v to the next v, between the centre and m.
  block.add(m, v, 0, 0.5);
  block.add(m, v, 1, 0.5);
  block.add(m, m, 0, 2 * w);
  block.add(m, v, 2, -w);
  block.add(m, v, -1, -w);
  block.add(m, d, 0, -w);
  block.add(m, d, 1, -w);
  return block;
}

TEST(Butterfly, SpectrumOfTwoRingsIsTheOneByHand) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum full("butterfly", n), half("butterfly", n, -1, {{"tension", "1/2"}});
    for (int k = 0; k < n; ++k) {
      expect_same_spectrum(full, k, two_rings(n, k, 1.0 / 16));
      expect_same_spectrum(half, k, two_rings(n, k, 1.0 / 32));
    }
  }
}

TEST(Butterfly, LeadingEigenvaluesOfBlockOneAreAsTabulated) {
  expect_table("butterfly",
               {.25, .46904152, .50667561, .5, .48191070, .46241777, .44442935, .42859991, .41487400, .40299786});
}

// 1/4 seven times: block 0 has the longest chain, so the vertex is a spike.
TEST(Butterfly, ThreeTrianglesMakeASpike) {
  const LocalSpectrum rings("butterfly", 3);
  EXPECT_EQ(rings.staircase(0, ratio(1, 4)), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(rings.staircase(1, ratio(1, 4)), (std::vector<int>{1, 2}));
  EXPECT_EQ(rings.staircase(2, ratio(1, 4)), (std::vector<int>{1, 2}));
  EXPECT_EQ(isolated_centre("butterfly", 3).masks.sides.at(0).plane, LimitMasks::Plane::no);
}

// At a regular vertex too 1/4 is defective: size 3 in block 0, 2 in blocks 2 and 4, hence derivatives that are
// Lipschitz but for a squared logarithm.
TEST(Butterfly, QuarterIsDefectiveAtRegularVertices) {
  const LocalSpectrum rings("butterfly", 6);
  EXPECT_EQ(rings.staircase(0, ratio(1, 4)), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(rings.staircase(2, ratio(1, 4)), (std::vector<int>{1, 2}));
  EXPECT_EQ(rings.staircase(4, ratio(1, 4)), (std::vector<int>{1, 2}));
  EXPECT_EQ(rings.staircase(1, ratio(1, 2)), std::vector<int>{1});
}

// Valences 4 to 7 have their tangents; from 8 on block 2 decays slower than block 1, and the surface winds twice.
TEST(Butterfly, FailsFromValenceEightOn) {
  for (const std::string tension : {"1", "1/2"})
    for (int n = 4; n <= 20; ++n) {
      const LocalSpectrum rings("butterfly", n, -1, {{"tension", tension}});
      double others = 0;
      for (int k = 0; 2 * k <= n; ++k)
        if (k != 1) others = std::max(others, rings.leading(k));
      const bool smooth = n <= 7;
      EXPECT_EQ(rings.leading(1) > others, smooth) << n;
      EXPECT_EQ(isolated_centre("butterfly", n, {{"tension", tension}}).masks.sides.at(0).plane,
                smooth ? LimitMasks::Plane::yes : LimitMasks::Plane::no)
          << n;
    }
  EXPECT_NEAR(LocalSpectrum("butterfly", 8).leading(2), .46904152, eight_cut_decimals);
  EXPECT_NEAR(LocalSpectrum("butterfly", 9).leading(2), .49729, five_decimals);
  const LocalSpectrum triangle("butterfly", 3, -1, {{"tension", "1/2"}});
  EXPECT_NEAR(triangle.leading(0), .42678, five_decimals);
  EXPECT_NEAR(triangle.leading(1), triangle.leading(0), closed_form);
}

TEST(Butterfly, CurvatureRatiosAreAsTabulated) {
  const std::pair<int, double> table[] = {{4, 1.136}, {5, .974}, {7, 1.749}};
  for (const auto& [n, expected] : table) {
    const LocalSpectrum rings("butterfly", n, 2);
    const double lambda = rings.leading(1);
    EXPECT_NEAR(rings.largest_below(lambda) / (lambda * lambda), expected, three_decimals) << n;
  }
}

// First mode with weight 1 on v, 1/16 on d, and -1/(2 sqrt 3) on m at its half angle.
TEST(Butterfly, RegularTangentsMatchTheClosedForm) {
  const Scheme<double> scheme = find_scheme("butterfly").value();
  const int m_columns = 10, width = m_columns + 1, centre = 5 * width + 5;
  const Level level = control_level(scheme, triangle_grid(m_columns, m_columns));
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(level, cache);
  // Neighbours in the grid, counter-clockwise: the diagonal goes from (i, j) to (i + 1, j + 1).
  const int steps[] = {1, width + 1, width, -1, -width - 1, -width};
  Eigen::VectorXd cosines = Eigen::VectorXd::Zero(width * width), sines = cosines;
  const auto set = [&](int at, double weight, double angle) {
    cosines[at] = weight * std::cos(angle);
    sines[at] = weight * std::sin(angle);
  };
  for (int i = 0; i < 6; ++i) {
    set(centre + steps[i], 1, i * pi / 3);
    set(centre + 2 * steps[i], 1.0 / 16, i * pi / 3);
    set(centre + steps[i] + steps[(i + 1) % 6], -0.5 / std::sqrt(3), (i + 0.5) * pi / 3);
  }
  const auto side =
      std::lower_bound(limit.side_vertex.begin(), limit.side_vertex.end(), centre) - limit.side_vertex.begin();
  expect_tangents(limit.tangent1.row(side).transpose(), limit.tangent2.row(side).transpose(), cosines, sines);
}

}  // namespace
}  // namespace sublimit::testing

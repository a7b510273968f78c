// SPDX-License-Identifier: Apache-2.0
// The way to a limit: what `explain` tells is what happens.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "laws/tested_schemes.h"
#include "meshes/meshes.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(LimitPath, OfARegularFaceIsItsPolynomial) {
  const LimitPath path = LimitMap(*find_scheme("catmull-clark"), torus(5, 6)).explain({3, 0.25, 0.5});
  ASSERT_EQ(path.steps.size(), 1u);
  EXPECT_EQ(path.steps[0].num_points, 16);
  EXPECT_EQ(path.steps[0].child, -1);
  EXPECT_EQ(path.end, LimitPath::End::polynomial);
  EXPECT_EQ(path.degree, 3);
  EXPECT_FALSE(path.is_total);
  EXPECT_TRUE(path.spectrum.empty());
  EXPECT_EQ(path.vertex, -1);
}

TEST(LimitPath, GoesDownUntilAPolynomialHasThePlace) {
  // On each level three quarters of a cube's face are polynomials; the quarter at the corner never is.
  const LimitMap cube_map(*find_scheme("catmull-clark"), cube());
  for (const int depth : {1, 3, 20}) {
    const LimitPath path = cube_map.explain({0, std::ldexp(0.75, -depth), std::ldexp(0.6, -depth)});
    EXPECT_EQ(path.end, LimitPath::End::polynomial);
    EXPECT_EQ(path.steps.back().level, depth + 1) << depth;
    int levels = 0;
    for (const LimitPath::Step& step : path.steps) levels += step.child < 0 ? 0 : step.times;
    EXPECT_EQ(levels, depth + 1);
    EXPECT_DOUBLE_EQ(path.steps.front().u, std::ldexp(0.75, -depth));
  }
}

TEST(LimitPath, EndsAtAVertexInItsSpectrum) {
  for (const Index n : {3, 5, 7}) {
    const Mesh mesh = fan(n, 4, 3);
    const LimitMap map(*find_scheme("catmull-clark"), mesh);
    const auto corners = map.level().topology().vertices(Face{0});
    const auto corner = std::find(corners.begin(), corners.end(), 0) - corners.begin();
    const LimitPath path = map.explain({0, double(corner == 1 || corner == 2), double(corner > 1)});
    EXPECT_EQ(path.end, LimitPath::End::corner);
    EXPECT_EQ(path.vertex, 0);
    EXPECT_EQ(path.rule, "smooth");
    ASSERT_GT(path.spectrum.size(), 3u);
    EXPECT_EQ(path.spectrum[0], 1.0);
    // Doo and Sabin 1978: the subdominant eigenvalue of Catmull and Clark's scheme.
    const double c = std::cos(2 * std::numbers::pi / n);
    const double lambda = (5 + c + std::sqrt((c + 9) * (c + 1))) / 16;
    constexpr double rounding = 1e-12;  // of a double eigenvalue
    for (const int i : {1, 2}) EXPECT_LE(std::abs(path.spectrum[size_t(i)] - lambda), rounding) << n;
  }
}

TEST(LimitPath, HasTheWeightsOfTheStencil) {
  for (const TestedScheme& tested : schemes_and_degrees()) {
    const Scheme<double> scheme = tested.scheme();
    for (const Mesh& mesh : hard_meshes(scheme, 4)) {
      const LimitMap map(scheme, mesh);
      for (const Place& place : {Place{0, 0, 0}, Place{1, 0.3, 0.2}, Place{2, 0.0625, 0.5}}) {
        const LimitPath path = map.explain(place, 1);
        const LimitStencil stencil = map.stencil(place, 1);
        EXPECT_EQ(path.stencil.vertices, stencil.vertices) << tested;
        EXPECT_EQ(path.stencil.weights, stencil.weights) << tested;
        EXPECT_EQ(path.stencil.status, stencil.status) << tested;
        ASSERT_FALSE(path.steps.empty());
        for (size_t i = 0; i + 1 < path.steps.size(); ++i) EXPECT_GE(path.steps[i].child, 0);
        EXPECT_EQ(path.steps.back().child, -1);
      }
    }
  }
}

TEST(LimitPath, RefusesPlacesThatAreNone) {
  const LimitMap map(*find_scheme("loop"), octahedron());
  expect_error<InvalidParameter>([&] { (void)map.explain({8, 0, 0}); }, {"8"});
  expect_error<InvalidParameter>([&] { (void)map.explain({0, 0.7, 0.7}); }, {"0.7"});
}

}  // namespace
}  // namespace sublimit::testing

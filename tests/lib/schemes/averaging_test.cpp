// SPDX-License-Identifier: Apache-2.0
// Zorin, Schroeder 2001, Stam 2001: repeated averaging at extraordinary places.
#include "sublimit/schemes/averaging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "sublimit/refine.h"
#include "sublimit/schemes.h"
#include "support/closed_form.h"
#include "support/meshes.h"
#include "support/regular_limit.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

SchemeOptions degree(int d) { return {{"degree", std::to_string(d)}}; }

TEST(Averaging, OfDegreeTwoIsDooSabinWithItsWeights) {
  for (const ControlMesh& mesh : {prism(5), jittered(octahedron()), quads_from_triangles(icosahedron())}) {
    const Level twice = refine(find_scheme("averaging", degree(2)).value(), mesh, 1)[1];
    const Level once = refine(find_scheme("doo-sabin-averaging").value(), mesh, 1)[1];
    EXPECT_LE((Eigen::MatrixXd(twice.S) - Eigen::MatrixXd(once.S)).cwiseAbs().maxCoeff(), rounding(16));
  }
}

// V = 9/16 v + 3/(8n) sum e_i + 1/(16n) sum f_i: totals that do not depend on n.
TEST(Averaging, OfDegreeThreeHasTheRegularTotals) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::MatrixXd S(refine(find_scheme("averaging").value(), fan(n), 1)[1].S);
    EXPECT_NEAR(S(0, 0), 9.0 / 16, rounding(16));
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(S(0, 1 + 2 * i), 3.0 / (8 * n), rounding(16)) << n;
      EXPECT_NEAR(S(0, 2 + 2 * i), 1.0 / (16 * n), rounding(16)) << n;
    }
  }
}

// Blocks k != 0 are those of Catmull and Clark.
TEST(Averaging, OfDegreeThreeHasTheSpectrumOfCatmullClarkBesidesBlockZero) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring("averaging", n);
    expect_eigenvalues(ring, 0, {1, ratio(1, 4), ratio(1, 16)});
    for (int k = 1; k < n; ++k) {
      const Precise c = cosine(k, n), root = sqrt((c + 1) * (c + 9));
      expect_eigenvalues(ring, k, {(5 + c + root) / 16, (5 + c - root) / 16});
    }
  }
}

// Block 0 knows no valence: where every sector has the same points, the averages are those of the regular mesh. There
// they are the powers of 1/4 that the polynomials x^2p y^2q have.
TEST(Averaging, BlockZeroIsTheRegularOneAtEveryValence) {
  for (const int d : {4, 5}) {
    const std::vector<std::complex<double>> regular = LocalSpectrum("averaging", 4, 1, degree(d)).power_sums(0);
    for (int n = 3; n <= 20; ++n) {
      const LocalSpectrum rings("averaging", n, 1, degree(d));
      const std::vector<std::complex<double>> ours = rings.power_sums(0);
      ASSERT_EQ(ours.size(), regular.size());
      for (size_t j = 0; j < ours.size(); ++j) EXPECT_LE(std::abs(ours[j] - regular[j]), closed_form) << d << " " << n;
      EXPECT_EQ(rings.multiplicity(0, 1), 1);
      EXPECT_EQ(rings.multiplicity(0, ratio(1, 4)), 1) << d << " " << n;
      EXPECT_GE(rings.multiplicity(0, ratio(1, 16)), 1) << d << " " << n;
    }
  }
}

// The limit mask is that of the B-spline in every sector, n sectors instead of four.
TEST(Averaging, LimitMasksAreTheBSplineSharedOutBetweenSectors) {
  for (int d = 2; d <= 9; ++d)
    for (const int n : {3, 4, 5, 6, 7, 8, 12, 20}) {
      const double start = d % 2 == 0 ? 0.5 : 1;
      std::vector<double> expected;
      if (d % 2 == 1) expected.push_back(cardinal_bspline(d, 0) * cardinal_bspline(d, 0));
      for (double x = start; 2 * x < d + 1; ++x)
        for (double y = start - (d % 2); 2 * y < d + 1; ++y)
          for (int s = 0; s < n; ++s) expected.push_back(4.0 / n * cardinal_bspline(d, x) * cardinal_bspline(d, y));
      const Eigen::VectorXd mask = lone_centre("averaging", n, degree(d)).masks.position;
      std::vector<double> ours(mask.begin(), mask.end());
      expected.resize(std::max(expected.size(), ours.size()), 0.0);
      ours.resize(expected.size(), 0.0);
      std::sort(expected.begin(), expected.end(), std::greater<>());
      std::sort(ours.begin(), ours.end(), std::greater<>());
      for (size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], expected[i], closed_form) << d << " " << n;
    }
}

TEST(Averaging, LambdaIsAsTabulated) {
  expect_table("averaging",
               {.41009705, .5, .54998835, .57968233, .59851028, .61111653, .61993922, .62634127, .63112759, .63479641},
               degree(3));
  expect_table("averaging",
               {.39659528, .5, .56823535, .61296197, .64303168, .66392581, .67891708, .68998668, .69836831, .70485452},
               degree(4));
  expect_table("averaging",
               {.40165379, .5, .56024742, .59806870, .62285937, .63981452, .65185251, .66067668, .66732292, .67244594},
               degree(5));
}

TEST(Averaging, TangentPlanesExistAtEveryDegreeAndValence) {
  for (int d = 2; d <= 9; ++d)
    for (int n = 3; n <= 12; ++n)
      EXPECT_EQ(lone_centre("averaging", n, degree(d)).masks.sides.at(0).plane, LimitMasks::Plane::yes)
          << d << " " << n;
}

}  // namespace
}  // namespace sublimit::testing

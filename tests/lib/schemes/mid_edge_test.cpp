// SPDX-License-Identifier: Apache-2.0
// Peters, Reif 1997 and Habib, Warren 1999: weights of one step and two, spectra, the degenerate triangle.
#include "sublimit/schemes/mid_edge.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

/// Weights of the corners of an isolated n-gon in the first corner of its child, two steps later.
Eigen::RowVectorXd two_steps(const std::string& name, int n) {
  return local_patch(find_scheme(name).value(), {.kind = Centre::Kind::face, .faces = n})->A.row(0);
}

TEST(MidEdge, TwoStepsWeighThreeCorners) {
  for (int n = 3; n <= 20; ++n) {
    Eigen::RowVectorXd expected = Eigen::RowVectorXd::Zero(n);
    expected[0] = 0.5;
    expected[1] = expected[n - 1] = 0.25;
    EXPECT_EQ(two_steps("mid-edge", n), expected) << n;
  }
}

// alpha_i = (1 + 2 sum_j 2^-j cos(2 pi i j/n))/n, 1 <= j < n/2; quads as above.
TEST(MidEdge, TwoStepsOfHabibAndWarrenWeighAllCorners) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::RowVectorXd ours = two_steps("mid-edge-habib-warren", n);
    for (int i = 0; i < n; ++i) {
      double alpha = 1.0 / n;
      for (int j = 1; 2 * j < n; ++j) alpha += 2.0 / n * std::pow(0.5, j) * std::cos(2 * pi * i * j / n);
      EXPECT_NEAR(ours[i], alpha, rounding(n)) << n;
    }
  }
  EXPECT_EQ(two_steps("mid-edge-habib-warren", 4), Eigen::RowVector4d(0.5, 0.25, 0, 0.25));
}

// On quads the two schemes are the same to the last bit, without small numbers where nothing should be.
TEST(MidEdge, OfHabibAndWarrenMakesMidpointsOnQuads) {
  const SparseMatrix simplest = refine(find_scheme("mid-edge").value(), torus(4, 5), 1)[1].S;
  const SparseMatrix habib_warren = refine(find_scheme("mid-edge-habib-warren").value(), torus(4, 5), 1)[1].S;
  EXPECT_EQ(Eigen::MatrixXd(habib_warren), Eigen::MatrixXd(simplest));
  EXPECT_EQ(habib_warren.nonZeros(), simplest.nonZeros());
}

// beta_i = (1 + 2 sum_j 2^(-j/2) cos(2 pi j (i - 1/2)/n))/n for the edge from corner 0 to 1: one of the new points that
// a prism's first n-gon makes with its quads.
TEST(MidEdge, OneStepOfHabibAndWarrenHasTheWeightsOfHalfTheWay) {
  for (int n = 3; n <= 20; ++n) {
    const Topology t(view(prism(n)));
    const Eigen::MatrixXd S(refine(find_scheme("mid-edge-habib-warren").value(), prism(n), 1)[1].S);
    Index polygon = 0;
    while (t.size(Face{polygon}) != n) ++polygon;
    Eigen::RowVectorXd expected = Eigen::RowVectorXd::Zero(t.num_vertices());
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      double beta = 1.0 / n;
      for (int j = 1; 2 * j < n; ++j) beta += 2.0 / n * std::pow(2, -j / 2.0) * std::cos(2 * pi * j * (i - 0.5) / n);
      expected[t.vertices(Face{polygon})[i]] = beta;
      sum += beta;
    }
    EXPECT_NEAR(sum, 1, rounding(n));
    EXPECT_LE((S.rowwise() - expected).rowwise().norm().minCoeff(), rounding(n)) << n;
  }
}

// Two steps on the corners: cos^2(pi k/n), or 2^-k; for even n the alternating corners vanish.
TEST(MidEdge, RingSpectraMatchTheClosedForms) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum simplest("mid-edge", n), habib_warren("mid-edge-habib-warren", n);
    for (int k = 0; k < n; ++k) {
      expect_eigenvalues(simplest, k, {(1 + cosine(k, n)) / 2});
      const int j = std::min(k, n - k);
      expect_eigenvalues(habib_warren, k, {2 * j == n ? Precise(0) : ratio(1, 1 << j)});
    }
  }
}

TEST(MidEdge, LambdaIsAsTabulated) {
  expect_table("mid-edge", {.25, .5, .65450850, .75, .81174490, .85355339, .88302222, .90450850, .92062677, .93301270});
}

// Triangles: 1/4 eight times among 12 points. Blocks 1 and 2 have three each with two eigenvectors, a Jordan block that
// decides: there is a tangent plane, and normals come to it like 1/steps.
TEST(MidEdge, TriangleIsTheJordanCase) {
  const LocalSpectrum rings("mid-edge", 3, 1);
  EXPECT_EQ(rings.size(0) + rings.size(1) + rings.size(2), 12);
  EXPECT_EQ(rings.staircase(0, ratio(1, 4)), std::vector<int>{2});
  EXPECT_EQ(rings.staircase(1, ratio(1, 4)), (std::vector<int>{2, 3}));
  EXPECT_EQ(rings.staircase(2, ratio(1, 4)), (std::vector<int>{2, 3}));
  EXPECT_EQ(isolated_centre("mid-edge", 3).masks.sides.at(0).plane, LimitMasks::Plane::slow);
}

TEST(MidEdge, PolygonsBeyondTheTriangleHaveASimplePair) {
  for (int n = 4; n <= 20; ++n) {
    const LocalSpectrum rings("mid-edge", n, 1);
    const double lambda = (1 + std::cos(2 * pi / n)) / 2;
    EXPECT_EQ(rings.staircase(1, (1 + cosine(1, n)) / 2), std::vector<int>{1}) << n;
    EXPECT_NEAR(rings.leading(1), lambda, closed_form) << n;
    for (int k = 0; k < n; ++k)
      if (k != 1 && k != n - 1) {
        EXPECT_LT(rings.leading(k), lambda) << n << " " << k;
      }
    EXPECT_EQ(isolated_centre("mid-edge", n).masks.sides.at(0).plane, LimitMasks::Plane::yes) << n;
  }
}

// Curvature vanishes at pentagons and beyond.
TEST(MidEdge, CurvatureRatiosAreAsTabulated) {
  const std::pair<int, double> table[] = {{5, .584}, {6, .444}, {8, .686}, {12, .862}};
  for (const auto& [n, expected] : table) {
    const LocalSpectrum rings("mid-edge", n, 1);
    const double lambda = rings.leading(1);
    EXPECT_NEAR(rings.largest_below(lambda) / (lambda * lambda), expected, three_decimals) << n;
  }
  for (int n = 5; n <= 20; ++n) {
    const LocalSpectrum rings("mid-edge", n, 1);
    EXPECT_LT(rings.largest_below(rings.leading(1)), rings.leading(1) * rings.leading(1)) << n;
  }
}

// Habib and Warren: lambda = 1/2, then 1/4 at every valence; in block 2 it is defective for n >= 5.
TEST(MidEdge, HabibAndWarrenHaveBoundedCurvatureUpToALogarithm) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("mid-edge-habib-warren", n, 1);
    EXPECT_NEAR(rings.leading(1), 0.5, closed_form) << n;
    EXPECT_NEAR(rings.largest_below(0.5), 0.25, closed_form) << n;
    EXPECT_EQ(rings.staircase(1, ratio(1, 2)), std::vector<int>{1}) << n;
    if (n >= 5) {
      EXPECT_EQ(rings.staircase(2, ratio(1, 4)).size(), 2u) << n;
    }
  }
}

TEST(MidEdge, LimitMasksAreCentroidAndFirstMode) {
  for (const std::string name : {"mid-edge", "mid-edge-habib-warren"})
    for (int n = 3; n <= 20; ++n) {
      const IsolatedLimit limit = isolated_centre(name, n);
      EXPECT_LE((limit.masks.position - Eigen::VectorXd::Constant(n, 1.0 / n)).norm(), closed_form) << n;
      expect_first_mode(limit, n, 0);
    }
}

}  // namespace
}  // namespace sublimit::testing

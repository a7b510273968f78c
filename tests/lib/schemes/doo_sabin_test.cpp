// SPDX-License-Identifier: Apache-2.0
// Doo, Sabin 1978. Facts of the paper and of Peters, Reif 1998, as closed forms.
#include "sublimit/schemes/doo_sabin.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

Eigen::RowVectorXd corner_row(const std::string& name, int n) {
  const Level level = refine(find_scheme(name).value(), prism(n), 1)[1];
  const Topology t(view(prism(n)));
  for (Index f = 0; f < t.num_faces(); ++f)
    if (t.size(Face{f}) == n && (n != 4 || f == 0)) {
      Eigen::RowVectorXd row(n);
      const Eigen::RowVectorXd all = Eigen::MatrixXd(level.S).row(index(level.steps[0].child(t.first(Face{f}))));
      for (int j = 0; j < n; ++j) row[j] = all[t.vertices(Face{f})[j]];
      EXPECT_NEAR(row.sum(), 1, rounding(n));
      return row;
    }
  return {};
}

TEST(DooSabin, CornersOfQuadsHaveTheTensorMask) {
  for (const std::string name : {"doo-sabin", "doo-sabin-averaging"}) {
    const Eigen::RowVectorXd row = corner_row(name, 4);
    EXPECT_LE((row - Eigen::RowVector4d(9, 3, 1, 3) / 16).norm(), rounding(4)) << name;
  }
}

TEST(DooSabin, CornersOfPolygonsHaveTheCosineWeights) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::RowVectorXd row = corner_row("doo-sabin", n);
    EXPECT_NEAR(row[0], (n + 5) / (4.0 * n), rounding(4));
    for (int j = 1; j < n; ++j) EXPECT_NEAR(row[j], (3 + 2 * std::cos(2 * pi * j / n)) / (4 * n), rounding(4)) << n;
  }
}

// (corner + centroid + two edge midpoints)/4; a triangle: 7/12, 5/24, 5/24.
TEST(DooSabin, AveragingTakesTheMeanOfCornerCentroidAndMidpoints) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::RowVectorXd row = corner_row("doo-sabin-averaging", n);
    for (int j = 0; j < n; ++j) {
      const double mid = j == 0 ? 1 : j == 1 || j == n - 1 ? 0.5 : 0;
      EXPECT_NEAR(row[j], ((j == 0) + 1.0 / n + mid) / 4, rounding(4)) << n;
    }
  }
  const Eigen::RowVectorXd triangle = corner_row("doo-sabin-averaging", 3);
  EXPECT_NEAR(triangle[0], 7.0 / 12, rounding(4));
  EXPECT_NEAR(triangle[1], 5.0 / 24, rounding(4));
}

// The n corners of a face: 1, 1/2 (k = 1, n-1), 1/4 else; with averaging weights 1/2 + c_k/4.
TEST(DooSabin, RingSpectraMatchTheClosedForms) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum cosines("doo-sabin", n), averages("doo-sabin-averaging", n);
    for (int k = 0; k < n; ++k) {
      ASSERT_EQ(cosines.size(k), 1);
      ASSERT_EQ(averages.size(k), 1);
      EXPECT_EQ(cosines.multiplicity(k, k == 0 ? ratio(1, 1) : k == 1 || k == n - 1 ? ratio(1, 2) : ratio(1, 4)), 1);
      EXPECT_EQ(averages.multiplicity(k, k == 0 ? Precise(1) : ratio(1, 2) + cosine(k, n) / 4), 1) << n << " " << k;
    }
  }
}

// Two rings of corners: 1/4 and below, all known to the paper; block k, 2 <= k < n/2, has 1/4 twice with one
// eigenvector, so curvature grows like a logarithm for n >= 5.
TEST(DooSabin, QuarterIsDefectiveInTheSaddleBlocks) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring("doo-sabin", n, 1);
    EXPECT_EQ(ring.staircase(1, ratio(1, 2)), std::vector<int>{1}) << n;
    EXPECT_NEAR(ring.largest_below(0.5), 0.25, closed_form) << n;
    for (int k = 2; 2 * k < n; ++k)
      EXPECT_EQ(ring.staircase(k, ratio(1, 4)), (std::vector<int>{1, 2})) << n << " " << k;
  }
}

// lambda is 1/2 + c/4, but for triangles that is 3/8 and the second ring shrinks slower than its square.
TEST(DooSabin, AveragingHasTheTabulatedCurvatureRatios) {
  const double ratios[] = {1.778, 1, 0.8935, 0.96, 1.033, 1.092};
  for (int n = 3; n <= 12; ++n) {
    if (n > 8 && n < 12) continue;
    const LocalSpectrum ring("doo-sabin-averaging", n, 1);
    const double lambda = 0.5 + std::cos(2 * pi / n) / 4;
    EXPECT_NEAR(ring.leading(1), lambda, closed_form) << n;
    EXPECT_NEAR(ring.largest_below(lambda) / (lambda * lambda), n == 12 ? 1.217 : ratios[n - 3], three_decimals) << n;
  }
}

// Centroids are fixed points; tangents are the first Fourier mode of the corners.
TEST(DooSabin, LimitMasksAreCentroidAndFirstMode) {
  for (const std::string name : {"doo-sabin", "doo-sabin-averaging"}) {
    for (int n = 3; n <= 20; ++n) {
      const IsolatedLimit limit = isolated_centre(name, n);
      const LimitMasks::Side& side = limit.masks.sides.at(0);
      ASSERT_EQ(limit.masks.position.size(), n);
      EXPECT_LE((limit.masks.position - Eigen::VectorXd::Constant(n, 1.0 / n)).norm(), closed_form) << n;
      expect_first_mode(limit, n, 0);
      EXPECT_NEAR(side.lambda1, name == "doo-sabin" ? 0.5 : 0.5 + std::cos(2 * pi / n) / 4, closed_form);
      EXPECT_EQ(side.plane, LimitMasks::Plane::yes);
    }
  }
}

// A vertex becomes a face, and its limit is that face's centroid. Corner points of a face are (9 a + 3 b + 3 c + d)/16:
// at the corner (1,1,1) of the cube (1, 1/2, 1/2) and so on, with the mean (2/3, 2/3, 2/3).
TEST(DooSabin, CubeCornersTendToTwoThirds) {
  for (const std::string name : {"doo-sabin", "doo-sabin-averaging"}) {
    const Scheme<double> scheme = find_scheme(name).value();
    const Level level = control_level(scheme, cube());
    LimitCache cache(scheme);
    const LimitPoints limit = limit_points(limit_matrices(level, cache), level.topology(), cube().positions);
    EXPECT_LE((limit.position - cube().positions * (2.0 / 3)).norm(), eigen()) << name;
    for (Index v = 0; v < 8; ++v)
      EXPECT_LE((limit.normal.row(v) - cube().positions.row(v).normalized()).norm(), eigen());
  }
}

}  // namespace
}  // namespace sublimit::testing

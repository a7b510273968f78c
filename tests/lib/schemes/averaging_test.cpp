// SPDX-License-Identifier: Apache-2.0
// Zorin, Schroeder 2001, Stam 2001: repeated averaging at extraordinary places.
#include "sublimit/schemes/averaging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"
#include "truth/regular_limit.h"

namespace sublimit::testing {
namespace {

SchemeOptions degree(int d) { return {{"degree", std::to_string(d)}}; }

TEST(Averaging, OfDegreeTwoIsDooSabinWithItsWeights) {
  for (const Mesh& mesh : {prism(5), jittered(octahedron()), quads_from_triangles(icosahedron())}) {
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

/// Block k != 0 of an isolated place, from the averages themselves: places are labelled (sector; x, y) in quarters of
/// the old mesh's unit, x along the sector's edge, and a label beyond an axis is one of the sector there.
class AveragedBlock {
 public:
  AveragedBlock(int degree, int n, int k, int points) : dual_(degree % 2 == 0), n_(n), k_(k), points_(points) {
    rings_ = 1;
    while ((dual_ ? rings_ * rings_ : rings_ * (rings_ + 1)) < points) ++rings_;
  }
  /// Row by row: the new point at a label lies at half of it in the old mesh.
  std::vector<std::complex<double>> power_sums(int degree) {
    Eigen::MatrixXcd B(points_, points_);
    for (int i = 0; i < points_; ++i) {
      const auto [x, y] = label(i);
      B.row(i) = average(degree - 1, x / 2, y / 2);
    }
    std::vector<std::complex<double>> sums;
    for (Eigen::MatrixXcd power = B; std::ssize(sums) < points_; power = (power * B).eval())
      sums.push_back(power.trace());
    return sums;
  }

 private:
  using Row = Eigen::RowVectorXcd;
  /// Old points: x = 1, 2 ... and y = 0, 1 ... in primal schemes, 1/2, 3/2 ... in dual ones.
  std::pair<int, int> label(int i) const {
    const int columns = dual_ ? rings_ : rings_ + 1, start = dual_ ? 2 : 4;
    return {start + 4 * (i / columns), (dual_ ? 2 : 0) + 4 * (i % columns)};
  }
  /// Weights of what `count` averagings make at a place that has such a point.
  Row average(int count, int x, int y) {
    if (x == 0 && y == 0) return Row::Zero(points_);  // the same in every sector
    if (x <= 0) return std::polar(1.0, 2 * std::numbers::pi * k_ / n_) * average(count, y, -x);
    if (y < 0) return std::polar(1.0, -2 * std::numbers::pi * k_ / n_) * average(count, -y, x);
    const auto found = known_.find({count, x, y});
    if (found != known_.end()) return found->second;
    return known_[{count, x, y}] = inside(count, x, y);
  }
  Row inside(int count, int x, int y) {
    const auto mean = [&](int c, int dx, int dy) -> Row {
      return (average(c, x + dx, y + dy) + average(c, x - dx, y + dy) + average(c, x + dx, y - dy) +
              average(c, x - dx, y - dy)) /
             4;
    };
    if (count > 0) return mean(count - 1, 1, 1);
    const int old = dual_ ? 2 : 0, dx = (x - old) % 4 == 0 ? 0 : 2, dy = (y - old) % 4 == 0 ? 0 : 2;
    if (dx > 0 || dy > 0) return mean(0, dx, dy);  // bilinear: a midpoint, or the middle of a face
    Row row = Row::Zero(points_);
    const int columns = dual_ ? rings_ : rings_ + 1, at = (x - (dual_ ? 2 : 4)) / 4 * columns + (y - old) / 4;
    if (x > 4 * rings_ || y > 4 * rings_) throw std::logic_error("the rings are not closed");
    row[at] = 1;
    return row;
  }
  bool dual_;
  int n_, k_, points_, rings_;
  std::map<std::array<int, 3>, Row> known_;
};

TEST(Averaging, SpectraAreThoseOfTheAveragesByHand) {
  for (int d = 2; d <= 9; ++d)
    for (int n = 3; n <= 20; ++n) {
      if (d > 5 && n != 3 && n != 5 && n != 8) continue;
      const LocalSpectrum rings("averaging", n, d % 2, degree(d));
      for (int k = 1; 2 * k <= n; ++k) {
        const int points = rings.size(k);
        const std::vector<std::complex<double>> ours = rings.power_sums(k);
        const std::vector<std::complex<double>> expected = AveragedBlock(d, n, k, points).power_sums(d);
        for (int j = 0; j < points; ++j)
          EXPECT_LE(std::abs(ours[j] - expected[j]), closed_form)
              << d << " " << n << " block " << k << " power " << j + 1;
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
      const Eigen::VectorXd mask = isolated_centre("averaging", n, degree(d)).masks.position;
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
      EXPECT_EQ(isolated_centre("averaging", n, degree(d)).masks.sides.at(0).plane, LimitMasks::Plane::yes)
          << d << " " << n;
}

}  // namespace
}  // namespace sublimit::testing

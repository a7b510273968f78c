// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/swept.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(Translational, AddsCurvesAndHasNoTwist) {
  std::mt19937 random(1);
  const CurveNet c = unit_curve(random, 3), d = unit_curve(random, 2);
  const Eigen::RowVector3d origin(1, 0, -1);
  const SplineNet net = translational(c, d, origin);
  for (const double u : {0.0, 0.3, 1.0})
    for (const double v : {0.0, 0.6, 1.0}) {
      const OwnValues at = own_values(net, u, v);
      expect_near(at.x.row(0), truth(c, u) + truth(d, v) - origin, sums);
      expect_near(at.x.row(4), Eigen::RowVector3d::Zero(), derivative_sums);
    }
}

TEST(Translational, MultipliesWeights) {
  std::mt19937 random(2);
  CurveNet c = homogeneous(unit_curve(random, 2)), d = homogeneous(unit_curve(random, 2));
  c.columns.row(1) *= 3, d.columns.row(1) *= 0.5;
  const SplineNet net = translational(c, d, Eigen::RowVector3d::Zero());
  const Eigen::RowVectorXd x = truth(c, 0.3), y = truth(d, 0.7);
  expect_near(own_values(net, 0.3, 0.7).x.row(0), x.head(3) / x[3] + y.head(3) / y[3], sums);
}

TEST(Sweep, PutsSectionsIntoFrames) {
  std::mt19937 random(3);
  const CurveNet section = unit_curve(random, 3);
  const Knots<double> path = unit_knots(random, 2);
  const Points origins = random_points(random, path.num_points(), 3);
  std::vector<Eigen::Matrix3d> matrices;
  Points entries(path.num_points(), 9);
  for (Index j = 0; j < path.num_points(); ++j) {
    const Points rows = random_points(random, 3, 3);
    matrices.emplace_back(rows);
    entries.row(j) = rows.reshaped<Eigen::RowMajor>();
  }
  const SplineNet net = sweep(section, path, origins, matrices);
  for (const double v : {0.0, 0.45, 1.0}) {
    const Eigen::RowVectorXd A = truth({path, entries}, v), o = truth({path, origins}, v), c = truth(section, 0.35);
    const Eigen::Matrix3d frame = A.reshaped<Eigen::RowMajor>(3, 3);
    expect_near(own_values(net, 0.35, v).x.row(0), o + c * frame.transpose(), sums);
  }
  expect_error<InvalidParameter>([&] { sweep(section, path, origins.topRows(1), matrices); },
                                 {"1 origins", "are needed"});
  matrices.pop_back();
  expect_error<InvalidParameter>([&] { sweep(section, path, origins, matrices); }, {"matrices", "are needed"});
}

TEST(Loft, HasItsSections) {
  std::mt19937 random(4);
  std::vector<CurveNet> sections;
  for (const int degree : {2, 3, 1, 3, 2}) sections.push_back(unit_curve(random, degree));
  const std::vector<double> parameters{0, 0.2, 0.5, 0.9, 1.5};
  for (const int degree_v : {1, 2, 3, 4}) {
    const SplineNet net = loft(sections, degree_v, parameters);
    for (size_t k = 0; k < sections.size(); ++k)
      for (const double u : {0.0, 0.3, 1.0})
        expect_near(own_values(net, u, parameters[k]).x.row(0), truth(sections[k], u), 10 * sums);
  }
  expect_error<InvalidParameter>([&] { loft(sections, 5, parameters); }, {"5 parameters for degree 5", "6 at least"});
  expect_error<InvalidParameter>(
      [&] {
        loft(sections, 2, std::vector<double>{0, 1});
      },
      {"2 parameters for 5 sections"});
  expect_error<InvalidParameter>(
      [&] {
        loft(sections, 2, std::vector<double>{0, 1, 1, 2, 3});
      },
      {"parameters 1 and 2 are both 1"});
}

}  // namespace
}  // namespace sublimit::testing

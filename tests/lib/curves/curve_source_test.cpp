// SPDX-License-Identifier: Apache-2.0
// Laws of all curves that are linear in their control points: limits of every scheme, splines, Lagrange curves, and
// sets of them.
#include "sublimit/curves/curve_source.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <functional>
#include <numeric>
#include <random>

#include "laws/curve_laws.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/patches/constructions/lagrange_curve.h"
#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/source/rational.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"

namespace sublimit::testing {
namespace {

constexpr Index size = 14;  // points of the polygons

/// Sums of the same products in another order, relative to their size; second derivatives are sums that cancel.
double sums(int derivative, double magnitude) { return rounding(64 << 2 * derivative, 1 + magnitude); }

/// Calls `law` with curves of every kind.
void for_each_curve(const std::function<void(const CurveSource&)>& law) {
  std::mt19937 random(7);
  for (const CurveScheme<double>& scheme : curve_scheme_variants())
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(scheme.name + (closed ? ", closed" : ", open"));
      ControlPolygon polygon = polygon_through(Points::Zero(size, 2), closed);
      polygon.tangents = polygon.points;
      law(LimitCurve(scheme, polygon));
    }
  std::vector<std::shared_ptr<const LinearCurve>> all;
  for (int degree = 1; degree <= 5; ++degree)
    for (const bool closed : {false, true})
      all.push_back(std::make_shared<const SplineCurve>(random_knots<double>(random, degree, closed)));
  all.push_back(std::make_shared<const LagrangeCurve>(LagrangeBasis({0, 0.5, 2, 3})));
  for (const auto& curve : all) {
    SCOPED_TRACE("a classical curve of " + std::to_string(curve->num_points()) + " points");
    law(*curve);
  }
  SCOPED_TRACE("a set");
  law(CurveSet(all));
}

/// Places at both ends of segments and in them, near an end and anywhere.
std::vector<CurvePlace> places(const CurveSource& curve) {
  std::vector<CurvePlace> all = curve.grid(5);
  for (Index segment = 0; segment < curve.num_segments(); ++segment)
    for (const double t : {0x1p-30, 0.37}) all.push_back({segment, t});
  return all;
}

/// Random points, and a derivative at each of them if the curve takes it.
Points random_columns(const CurveSource& curve, Index dimension, unsigned seed = 3) {
  std::mt19937 random(seed);
  return random_points(random, curve.num_unknowns(), dimension);
}

/// Homogeneous columns of weights in [1/2, 2]; derivatives of weights are small.
Points random_homogeneous(const CurveSource& curve) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0.5, 2);
  Points columns = random_columns(curve, 4);
  for (Index i = 0; i < columns.rows(); ++i)
    if (i % curve.unknowns_per_point() == 0) {
      columns(i, 3) = weight(random);
      columns.row(i).head(3) *= columns(i, 3);
    } else {
      columns(i, 3) *= 0.1;
    }
  return columns;
}

TEST(CurveSource, RowsSumToOneAndZero) {
  for_each_curve([](const CurveSource& curve) {
    for (const CurvePlace& place : places(curve)) {
      const CurveStencil stencil = curve.stencil(place, 2);
      EXPECT_TRUE(std::is_sorted(stencil.unknowns.begin(), stencil.unknowns.end(), std::less_equal<>()));
      EXPECT_GE(stencil.unknowns.front(), 0);
      EXPECT_LT(stencil.unknowns.back(), curve.num_unknowns());
      for (Eigen::Index k = 0; k < stencil.weights.rows(); ++k) {
        double sum = 0, magnitude = 0;
        for (size_t i = 0; i < stencil.unknowns.size(); ++i)
          if (stencil.unknowns[i] % curve.unknowns_per_point() == 0) {
            sum += stencil.weights(k, Eigen::Index(i));
            magnitude += std::abs(stencil.weights(k, Eigen::Index(i)));
          }
        EXPECT_NEAR(sum, k == 0 ? 1 : 0, rounding(64, magnitude));
      }
    }
  });
}

TEST(CurveSource, SamplesAreStencilsTimesColumns) {
  for_each_curve([](const CurveSource& curve) {
    const Points columns = random_columns(curve, 3);
    const std::vector<CurvePlace> at = places(curve);
    for (int order = 0; order <= 2; ++order) {
      const CurveSamples samples = curve.evaluate(columns, at, order);
      const PlaceStencils matrices = place_stencils(curve, at, order);
      ASSERT_EQ(std::ssize(matrices.matrices), order + 1);
      for (int k = 0; k <= order; ++k) {
        const Points expected = matrices.matrices[size_t(k)] * columns;
        for (Eigen::Index i = 0; i < expected.rows(); ++i) {
          const double magnitude = matrices.matrices[size_t(k)].row(i).cwiseAbs().sum();
          EXPECT_LE((samples.part(k).row(i) - expected.row(i)).norm(), sums(0, magnitude)) << i << " " << k;
        }
      }
      for (size_t i = 0; i < at.size(); ++i) {
        const CurveStencil stencil = curve.stencil(at[i], order);
        EXPECT_EQ(samples.status[i], stencil.status);
        EXPECT_EQ(samples.order[i], stencil.weights.rows() - 1);
        EXPECT_EQ(matrices.status[i], stencil.status);
      }
    }
  });
}

/// A curve that has nothing but its stencils.
class StencilsAlone : public CurveSource {
 public:
  explicit StencilsAlone(const CurveSource& curve) : curve_(curve) {}
  Index num_segments() const override { return curve_.num_segments(); }
  Index num_points() const override { return curve_.num_points(); }
  Index unknowns_per_point() const override { return curve_.unknowns_per_point(); }
  CurveStencil stencil(const CurvePlace& place, int order) const override { return curve_.stencil(place, order); }

 private:
  const CurveSource& curve_;
};

TEST(CurveSource, HasTheSamplesOfItsStencilsAlone) {
  for_each_curve([](const CurveSource& curve) {
    const std::vector<CurvePlace> at = places(curve);
    for (const Coordinates coordinates : {Coordinates::plain, Coordinates::homogeneous}) {
      const Points columns =
          coordinates == Coordinates::plain ? random_columns(curve, 3) : Points(random_homogeneous(curve));
      const CurveSamples samples = curve.evaluate(columns, at, 2, coordinates),
                         expected = StencilsAlone(curve).evaluate(columns, at, 2, coordinates);
      EXPECT_EQ(samples.status, expected.status);
      EXPECT_EQ(samples.order, expected.order);
      for (Eigen::Index i = 0; i < std::ssize(at); ++i) {
        const double magnitude = curve.stencil(at[size_t(i)], 2).weights.cwiseAbs().sum();
        for (int k = 0; k <= 2; ++k)
          EXPECT_LE((samples.part(k).row(i) - expected.part(k).row(i)).norm(), sums(0, magnitude)) << i << " " << k;
      }
    }
  });
}

TEST(CurveSource, OfWeightsOneIsThePlainCurve) {
  for_each_curve([](const CurveSource& curve) {
    Points columns = random_columns(curve, 4);
    for (Index i = 0; i < columns.rows(); ++i) columns(i, 3) = i % curve.unknowns_per_point() == 0 ? 1 : 0;
    const std::vector<CurvePlace> at = places(curve);
    const CurveSamples plain = curve.evaluate(columns.leftCols(3), at, 2),
                       rational = curve.evaluate(columns, at, 2, Coordinates::homogeneous);
    EXPECT_EQ(plain.status, rational.status);
    EXPECT_EQ(plain.order, rational.order);
    for (int k = 0; k <= 2; ++k)
      for (Eigen::Index i = 0; i < std::ssize(at); ++i) {
        const double magnitude = curve.stencil(at[size_t(i)], 2).weights.cwiseAbs().sum();
        EXPECT_LE((plain.part(k).row(i) - rational.part(k).row(i)).norm(), sums(k, magnitude * magnitude))
            << i << " " << k;
      }
  });
}

// The curve of mapped columns is the image: (A, w) -> M (A, w), and derivatives go by the quotient rule.
TEST(CurveSource, MapsOfColumnsAreProjectiveMapsOfTheCurve) {
  std::mt19937 random(14);
  const Eigen::Matrix4d map = Eigen::Matrix4d::Identity() + 0.05 * Eigen::Matrix4d(random_points(random, 4, 4));
  for_each_curve([&](const CurveSource& curve) {
    const Points columns = random_homogeneous(curve);
    const std::vector<CurvePlace> at = places(curve);
    const CurveSamples samples = curve.evaluate(columns, at, 1, Coordinates::homogeneous),
                       mapped = curve.evaluate(columns * map.transpose(), at, 1, Coordinates::homogeneous);
    for (Eigen::Index i = 0; i < std::ssize(at); ++i) {
      ASSERT_EQ(samples.order[size_t(i)], mapped.order[size_t(i)]);
      const Eigen::Vector4d x = map * Eigen::RowVector3d(samples.position.row(i)).transpose().homogeneous();
      EXPECT_LE((mapped.position.row(i).transpose() - x.head(3) / x[3]).norm(), other_route * (1 + x.norm() / x[3]));
      if (samples.order[size_t(i)] < 1) continue;
      Eigen::Vector4d direction = Eigen::Vector4d::Zero();
      direction.head(3) = samples.first.row(i);
      const Eigen::Vector4d d = map * direction;
      const Eigen::Vector3d first = (d.head(3) - d[3] * x.head(3) / x[3]) / x[3];
      EXPECT_LE((mapped.first.row(i).transpose() - first).norm(), other_route * (1 + first.norm()));
    }
  });
}

TEST(CurveSource, CountsUnknowns) {
  const CurveScheme<double> hermite = curve_scheme("hermite-merrien");
  ControlPolygon polygon = polygon_through(Points::Zero(5, 2));
  polygon.tangents = polygon.points;
  const LimitCurve limit(hermite, polygon);
  EXPECT_EQ(limit.num_points(), 5);
  EXPECT_EQ(limit.unknowns_per_point(), 2);
  EXPECT_EQ(limit.num_unknowns(), unknowns(hermite, polygon).rows());
  const SplineCurve spline(bezier_knots<double>(3));
  EXPECT_EQ(spline.num_points(), 4);
  EXPECT_EQ(spline.num_unknowns(), 4);
}

TEST(CurveSource, AGridHasBothEndsOfEverySegment) {
  for_each_curve([](const CurveSource& curve) {
    const std::vector<CurvePlace> grid = curve.grid(4);
    ASSERT_EQ(std::ssize(grid), 4 * curve.num_segments());
    for (size_t i = 0; i < grid.size(); ++i) {
      EXPECT_EQ(grid[i].segment, Index(i / 4));
      EXPECT_EQ(grid[i].t, double(i % 4) / 3);
    }
    expect_error<InvalidParameter>([&] { (void)curve.grid(1); }, {"grid of 1", "2 or more"});
  });
}

TEST(CurveSource, RefusesWhatIsNotThere) {
  for_each_curve([](const CurveSource& curve) {
    const Points columns = random_columns(curve, 2);
    const Index last = curve.num_segments() - 1;
    const CurvePlace behind[] = {{0, 0}, {last + 1, 0}}, outside[] = {{last, 1.5}};
    expect_error<InvalidParameter>([&] { (void)curve.stencil(behind[1]); }, {"does not exist"});
    expect_error<InvalidParameter>([&] { (void)curve.evaluate(columns, behind); }, {"sample 1", "does not exist"});
    expect_error<InvalidParameter>([&] { (void)curve.evaluate(columns, outside); }, {"sample 0", "t is 1.5"});
    expect_error<InvalidParameter>([&] { (void)curve.evaluate(columns, {}, 3); }, {"order 3"});
    expect_error<InvalidParameter>([&] { (void)place_stencils(curve, behind, 0); }, {"does not exist"});
    expect_error<InvalidParameter>([&] { (void)curve.evaluate(columns.topRows(1), {}); },
                                   {"1 x 2", std::to_string(curve.num_points()) + " control points"});
  });
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Affine maps of all data of a construction map what it makes: nets of mapped data are mapped nets.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "meshes/construction_data.h"
#include "sublimit/patches/constructions/coons.h"
#include "sublimit/patches/constructions/gordon.h"
#include "sublimit/patches/constructions/hermite.h"
#include "sublimit/patches/constructions/interpolation.h"
#include "sublimit/patches/constructions/lagrange_curve.h"
#include "sublimit/patches/constructions/ruled.h"
#include "sublimit/patches/constructions/swept.h"

namespace sublimit::testing {
namespace {

/// x -> A x + b of points; vectors are turned and scaled alone; columns (w x, w) by their weights.
struct AffineMap {
  Eigen::Matrix3d A;
  Eigen::RowVector3d b;

  Points vectors(const Points& v) const { return v * A.transpose(); }
  Points points(const Points& p) const { return vectors(p).rowwise() + b; }
  Points columns(const Points& c) const {
    if (c.cols() == 3) return points(c);
    Points result = c;
    result.leftCols(3) = c.leftCols(3) * A.transpose() + c.col(3) * b;
    return result;
  }
  CurveNet curve(CurveNet net) const {
    net.columns = columns(net.columns);
    return net;
  }
};

/// The columns that a construction makes of its data, mapped before.
struct AffineConstruction {
  std::string name;
  std::function<Points(const AffineMap&)> columns;
};

CoonsBoundary mapped(const AffineMap& map, const CoonsBoundary& curves) {
  return {map.curve(curves[0]), map.curve(curves[1]), map.curve(curves[2]), map.curve(curves[3])};
}

CoonsBoundary closed_boundary(CoonsBoundary curves) {
  curves[2].columns.row(0) = curves[0].columns.row(0);
  curves[3].columns.row(0) = curves[0].columns.bottomRows(1);
  curves[2].columns.bottomRows(1) = curves[1].columns.row(0);
  curves[3].columns.bottomRows(1) = curves[1].columns.bottomRows(1);
  return curves;
}

std::vector<AffineConstruction> affine_constructions(std::mt19937& random) {
  const CurveNet c = unit_curve(random, 3), d = unit_curve(random, 2);
  CurveNet rational = unit_curve(random, 2);
  rational = homogeneous(rational);
  for (Eigen::Index i = 0; i < rational.columns.rows(); ++i) rational.columns.row(i) *= 1 + 0.25 * double(i % 3);
  const CoonsBoundary boundary =
      closed_boundary({unit_curve(random, 3), unit_curve(random, 2), unit_curve(random, 3), unit_curve(random, 1)});
  const auto parabola = [&] { return CurveNet{bezier_knots<double>(2), random_points(random, 3, 3)}; };
  const CoonsBoundary network = closed_boundary({parabola(), parabola(), parabola(), parabola()});
  const Points data = random_points(random, 16, 3), grid = random_points(random, 12, 3);
  const Eigen::RowVector3d one(0.3, -0.7, 0.2);
  const auto section = [&] { return CurveNet{c.knots, random_points(random, c.knots.num_points(), 3)}; };
  const std::vector<CurveNet> sections{c, section(), section()};
  const std::vector<double> parameters{0, 0.4, 1};
  const auto hermite = [data](HermiteVectors vectors, const AffineMap& map) {
    Points all(vectors == HermiteVectors::sixteen ? 16 : 12, 3);
    all << map.points(data.topRows(4)), map.vectors(data.middleRows(4, all.rows() - 4));
    return hermite_patch(vectors, all).columns;
  };
  std::vector<AffineConstruction> all{
      {"ruled", [=](const AffineMap& map) { return ruled(map.curve(c), map.curve(d)).columns; }},
      {"ruled, rational", [=](const AffineMap& map) { return ruled(map.curve(c), map.curve(rational)).columns; }},
      {"extrusion", [=](const AffineMap& map) { return extrusion(map.curve(rational), map.vectors(one)).columns; }},
      {"cone", [=](const AffineMap& map) { return cone(map.curve(rational), map.points(one)).columns; }},
      {"translational",
       [=](const AffineMap& map) { return translational(map.curve(c), map.curve(rational), map.points(one)).columns; }},
      {"loft",
       [=](const AffineMap& map) {
         std::vector<CurveNet> curves;
         for (const CurveNet& one_of : sections) curves.push_back(map.curve(one_of));
         return loft(curves, 2, parameters).columns;
       }},
      {"interpolation",
       [=](const AffineMap& map) {
         return interpolating_points(averaged_knots(2, parameters), parameters, map.points(grid.topRows(3)));
       }},
      {"natural cubic",
       [=](const AffineMap& map) {
         return interpolating_cubic(CubicEnds::natural, parameters, map.points(grid.topRows(3))).columns;
       }},
      {"clamped cubic",
       [=](const AffineMap& map) {
         return interpolating_cubic(CubicEnds::clamped, parameters, map.points(grid.topRows(3)),
                                    map.vectors(grid.bottomRows(2)))
             .columns;
       }},
      {"Lagrange",
       [=](const AffineMap& map) {
         const std::vector<double> in_u{0, 0.3, 0.6, 1}, in_v{0, 0.5, 1};
         return lagrange_net(LagrangeBasis(in_u), LagrangeBasis(in_v), map.points(grid)).value().columns;
       }},
      {"Gordon",
       [=](const AffineMap& map) {
         const CoonsBoundary curves = mapped(map, network);
         return gordon({{curves[0], curves[1]}, {curves[2], curves[3]}, {0, 1}, {0, 1}}, GordonBlending::lagrange)
             .columns;
       }},
  };
  for (const CoonsBlending blending : {CoonsBlending::bilinear, CoonsBlending::bicubic})
    all.push_back({"Coons", [=](const AffineMap& map) { return coons(mapped(map, boundary), blending).columns; }});
  for (const HermiteVectors vectors : {HermiteVectors::twelve, HermiteVectors::sixteen, HermiteVectors::adini})
    all.push_back({"Hermite", [=](const AffineMap& map) { return hermite(vectors, map); }});
  return all;
}

TEST(Constructions, CommuteWithAffineMapsOfTheirData) {
  std::mt19937 random(51);
  const AffineMap identity{Eigen::Matrix3d::Identity(), Eigen::RowVector3d::Zero()};
  const AffineMap translation{Eigen::Matrix3d::Identity(), {3, -2, 5}};
  const AffineMap rotation{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix(),
                           Eigen::RowVector3d::Zero()};
  const AffineMap scaling{2.5 * Eigen::Matrix3d::Identity(), Eigen::RowVector3d::Zero()};
  AffineMap general{Eigen::Matrix3d::Identity(), {-1, 0.5, 2}};
  general.A += 0.5 * Eigen::Matrix3d(random_points(random, 3, 3));
  for (const AffineConstruction& construction : affine_constructions(random)) {
    SCOPED_TRACE(construction.name);
    const Points plain = construction.columns(identity);
    for (const AffineMap& map : {translation, rotation, scaling, general})
      expect_near(construction.columns(map), map.columns(plain), 10 * sums);  // of points that lie ten times as far out
  }
}

}  // namespace
}  // namespace sublimit::testing

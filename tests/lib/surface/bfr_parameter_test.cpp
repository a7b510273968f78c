// SPDX-License-Identifier: Apache-2.0
// Addresses in polygons against Bfr's parameters, live.
#include <gtest/gtest.h>

#include <opensubdiv/bfr/parameterization.h>

#include "meshes/meshes.h"
#include "peers/opensubdiv_limit_reference.h"
#include "sublimit/source/address.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using OpenSubdiv::Bfr::Parameterization;

// Perfect squares and their neighbours change how many squares are in a row.
constexpr Index polygons[] = {3, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17, 24, 25, 26, 100, 101, 250};

Parameterization bfr(Index corners) { return {OpenSubdiv::Sdc::SCHEME_CATMARK, corners}; }

TEST(BfrParameter, SquaresOfPolygonsLieWhereBfrHasThem) {
  for (const Index n : polygons) {
    const Parameterization theirs = bfr(n);
    ASSERT_TRUE(theirs.HasSubFaces());
    for (Index i = 0; i < n; ++i)
      for (const double u : {0.0, 0.125, 0.5, 0.75, 1.0})
        for (const double v : {0.0, 0.25, 0.625, 1.0}) {
          const double sub_face[2] = {u, v};
          double expected[2], back[2];
          theirs.ConvertNormalizedSubFaceToCoord(i, sub_face, expected);
          const BfrParameter p = to_bfr(n, i, u, v);
          EXPECT_EQ(p.u, expected[0]) << "square " << i << " of " << n;
          EXPECT_EQ(p.v, expected[1]) << "square " << i << " of " << n;
          const Place ours = from_bfr(n, p);
          EXPECT_EQ(ours.face, theirs.ConvertCoordToNormalizedSubFace(expected, back));
          EXPECT_EQ(ours.face, i);
          EXPECT_EQ(ours.u, back[0]);
          EXPECT_EQ(ours.v, back[1]);
          EXPECT_EQ(ours.u, u);
          EXPECT_EQ(ours.v, v);
        }
  }
}

TEST(BfrParameter, CornersEdgesAndCentreOfPolygonsAreBfrs) {
  for (const Index n : polygons) {
    const Parameterization theirs = bfr(n);
    double expected[2];
    for (Index i = 0; i < n; ++i) {
      theirs.GetVertexCoord(i, expected);
      EXPECT_EQ(to_bfr(n, i, 0, 0).u, expected[0]);
      EXPECT_EQ(to_bfr(n, i, 0, 0).v, expected[1]);
      theirs.GetEdgeCoord(i, 0.25, expected);  // the first half of an edge is u of its tail's square
      EXPECT_EQ(to_bfr(n, i, 0.5, 0).u, expected[0]);
      EXPECT_EQ(to_bfr(n, i, 0.5, 0).v, expected[1]);
      theirs.GetEdgeCoord(i, 0.75, expected);  // the second half is v of its head's, backwards
      EXPECT_EQ(to_bfr(n, (i + 1) % n, 0, 0.5).u, expected[0]);
      EXPECT_EQ(to_bfr(n, (i + 1) % n, 0, 0.5).v, expected[1]);
    }
    theirs.GetCenterCoord(expected);
    EXPECT_EQ(to_bfr(n, 0, 1, 1).u, expected[0]);
    EXPECT_EQ(to_bfr(n, 0, 1, 1).v, expected[1]);
  }
}

TEST(BfrParameter, NoSquareIsAnError) {
  for (const auto& [u, v] : {std::pair(0.75, 0.0), std::pair(0.0, 0.75), std::pair(-0.25, 0.0), std::pair(3.0, 0.0),
                             std::pair(2.0, 1.0), std::pair(std::nan(""), 0.0)})
    EXPECT_THROW(from_bfr(5, {u, v}), InvalidParameter) << u << ", " << v;
}

/// Derivative of a polynomial of degree 4 and less.
Eigen::Vector3d derivative(const auto& f, double x, double h) {
  return (f(x - 2 * h) - f(x + 2 * h) + 8 * (f(x + h) - f(x - h))) / (12 * h);
}

// (u,v) of a square of ours has twice the size of Bfr's and of Far's, so that d/du of theirs is twice ours, where ours
// is that of the position as a function of our own (u,v).
TEST(BfrParameter, DerivativesOnSquaresOfPolygonsAreTwiceOurs) {
  const Mesh mesh = jittered(polygon_ring({4, 5, 4, 6, 5}));
  const ReferenceOptions scheme = reference_options(mesh, "catmull-clark", 0);
  const FarLimit far(mesh, scheme, {});
  const BfrLimit bfr(mesh, scheme, {});
  const Addresses addresses(
      Topology(
          {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.face_vertices, .face_sizes = mesh.face_sizes}),
      false);
  const double h = 1.0 / 64;
  int squares = 0;
  for (Index a = 0; a < addresses.size(); ++a) {
    const double factor = addresses.place(a).corner < 0 ? 1 : 2;
    squares += factor == 2;
    const Place place{a, 0.625, 0.375};  // inside one piece of level 1, away from extraordinary corners
    const auto compare = [&](const auto& limit, const char* who) {
      const ReferencePoint p = limit.at(place).value();
      const auto x = [&](double u, double v) { return limit.at({a, u, v}).value().position; };
      const double noise = rounding(16, diagonal(mesh.positions)) / h;
      const Eigen::Vector3d du = derivative([&](double u) { return x(u, place.v); }, place.u, h);
      const Eigen::Vector3d dv = derivative([&](double v) { return x(place.u, v); }, place.v, h);
      EXPECT_LE((p.du - factor * du).norm(), factor * noise) << who << ", address " << a;
      EXPECT_LE((p.dv - factor * dv).norm(), factor * noise) << who << ", address " << a;
      const Eigen::Vector3d duv = derivative(
          [&](double u) {
            return limit.at({a, u, place.v}).value().dv;
          },
          place.u, h);
      EXPECT_LE((p.duv - factor * duv).norm(), factor * factor * noise / h) << who << ", address " << a;
    };
    if (far.at(place)->regular) compare(far, "Far");
    if (far.at(place)->regular) compare(bfr, "Bfr");
  }
  EXPECT_GE(squares, 5);
}

}  // namespace
}  // namespace sublimit::testing

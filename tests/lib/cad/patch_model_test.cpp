// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/patch_model.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/spline_models.h"
#include "sublimit/cad/patch_integrals.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::cad_exact;
using testing::rounding;
using testing::SplineModel;

std::vector<NamedPatch> patches_of(const SplineModel& model) {
  std::vector<NamedPatch> patches;
  for (size_t p = 0; p < model.surfaces.size(); ++p)
    patches.push_back({std::make_shared<const SplineSurface>(model.surfaces[p]), model.columns[p], model.coordinates});
  return patches;
}

/// Bilinear patches by their corners, u fastest.
SplineModel bilinear(const std::vector<std::array<Eigen::RowVector3d, 4>>& patches) {
  SplineModel model;
  for (const auto& corners : patches) {
    model.add(bezier_knots<double>(1), bezier_knots<double>(1));
    for (Index i = 0; i < 4; ++i) model.columns.back().row(i) = corners[size_t(i)];
  }
  return model;
}

/// The same strip in two patches, and a half turn in it or none.
SplineModel strip(bool half_turn) {
  const Eigen::RowVector3d a(0, 0, 0), b(1, 0, 0), c(0, 0, 1), d(1, 0, 1), e(0, 1, 0.5), f(1, 1, 0.5);
  return bilinear({{a, b, e, f}, {e, f, c, d}, half_turn ? std::array{c, d, b, a} : std::array{c, d, a, b}});
}

TEST(PatchModel, EdgesAreUsedAsFacesMeet) {
  const PatchModel cube = patch_model(patches_of(testing::bilinear_cube()));
  std::vector<int> uses(cube.boundary.edges.size()), balance(uses);
  for (const SplineFace& face : cube.boundary.faces)
    for (const EdgeUse& use : face.border) {
      const SplineEdge& edge = cube.boundary.edges[size_t(use.edge)];
      ++uses[size_t(use.edge)], balance[size_t(use.edge)] += use.reversed != face.reversed ? 1 : -1;
      EXPECT_EQ((use.to - use.from).norm(), edge.knots.back() - edge.knots.front());
      // Ends of the edge are its vertices.
      EXPECT_EQ(edge.poles.row(0), cube.boundary.vertices.row(edge.start));
      EXPECT_EQ(edge.poles.row(edge.poles.rows() - 1), cube.boundary.vertices.row(edge.end));
    }
  EXPECT_EQ(uses, std::vector<int>(12, 2));
  EXPECT_EQ(balance, std::vector<int>(12, 0));
  EXPECT_NEAR(cube.area, 24, 24 * cad_exact);
}

TEST(PatchModel, ASurfaceOfOneSideStaysOpen) {
  EXPECT_EQ(patch_model(patches_of(strip(false))).shared, 3);
  const PatchModel moebius = patch_model(patches_of(strip(true)));
  EXPECT_EQ(moebius.shared, 2);
  EXPECT_EQ(moebius.unsuitable, 1);
}

TEST(PatchModel, SidesThatCannotBeOneEdgeHaveTheirOwn) {
  const Eigen::RowVector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), xy(1, 1, 0), y2(0, 2, 0), xy2(1, 2, 0), z(0, 1, 1),
      xz(1, 1, 1);
  // Three at one side.
  const PatchModel three = patch_model(patches_of(bilinear({{o, x, y, xy}, {y, xy, y2, xy2}, {y, xy, z, xz}})));
  EXPECT_EQ(three.non_manifold, 1);
  EXPECT_EQ(three.boundary.edges.size(), 12u);
  // Sides of one patch that meet in a corner: folded shut, twice.
  const PatchModel folded = patch_model(patches_of(bilinear({{o, x, x, z}})));
  EXPECT_EQ(folded.unsuitable, 2);
  EXPECT_EQ(folded.boundary.edges.size(), 4u);
  EXPECT_EQ(folded.boundary.vertices.rows(), 3);
  // One shape in two parameters.
  SplineModel slow = bilinear({{o, x, y, xy}});
  slow.add(bezier_knots<double>(2), bezier_knots<double>(1));
  slow.columns[1] << 0, -1, 0, 0.2, -1, 0, 1, -1, 0, 0, 0, 0, 0.2, 0, 0, 1, 0, 0;
  EXPECT_EQ(patch_model(patches_of(slow)).reparametrised, 1);
  slow.columns[0].row(1) << 2, 0, 0;
  const PatchModel part = patch_model(patches_of(slow));
  EXPECT_EQ(part.partial, 1);
  EXPECT_EQ(part.shared, 0);
}

TEST(PatchModel, SidesOnPartsOfOthersAreCut) {
  const auto at = [](double x, double y) { return Eigen::RowVector3d(x, y, 0.5 * x); };
  // 0 .. 3 above; 0 .. 1 and 1 .. 2.5 below, the first one upside down.
  const PatchModel model = patch_model(patches_of(bilinear({{at(0, 0), at(3, 0), at(0, 1), at(3, 1)},
                                                            {at(1, 0), at(0, 0), at(1, -1), at(0, -1)},
                                                            {at(1, -1), at(2.5, -1), at(1, 0), at(2.5, 0)}})));
  EXPECT_EQ(model.shared, 3);  // two with the upper one, one with each other
  EXPECT_EQ(model.partial, 0);
  EXPECT_EQ(model.boundary.faces[0].border.size(), 6u);
  EXPECT_EQ(model.boundary.edges.size(), 4u + 2 + 3 + 2);
  EXPECT_EQ(model.boundary.vertices.rows(), 6 + 3);
  // Sides that overlap: 0 .. 2 and 1 .. 3.
  const PatchModel staggered = patch_model(
      patches_of(bilinear({{at(0, 0), at(2, 0), at(0, 1), at(2, 1)}, {at(1, -1), at(3, -1), at(1, 0), at(3, 0)}})));
  EXPECT_EQ(staggered.shared, 1);
  EXPECT_EQ(staggered.boundary.edges.size(), 9u);
  EXPECT_LT(staggered.gap, cad_exact);
}

TEST(PatchModel, NearSidesAreOneWithinTheTolerance) {
  SplineModel cube = testing::bilinear_cube();
  cube.columns[2].col(1).array() += 1e-5;
  EXPECT_EQ(patch_model(patches_of(cube)).shared, 8);
  const PatchModel joined = patch_model(patches_of(cube), {.same = 1e-4});
  EXPECT_EQ(joined.shared, 12);
  EXPECT_NEAR(joined.gap, 1e-5, cad_exact);
}

TEST(PatchModel, RefusesNothingToWrite) {
  testing::expect_error<InvalidParameter>([] { patch_model({}); }, {"no patches"});
  SplineModel broken = testing::bilinear_cube();
  broken.columns[3](1, 2) = NAN;
  testing::expect_error<InvalidParameter>([&] { patch_model(patches_of(broken)); }, {"patch 3", "not finite"});
}

TEST(PatchModel, RefusesPatchesWithoutArea) {
  std::vector<NamedPatch> patches =
      patches_of(bilinear({{Eigen::RowVector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                           {Eigen::RowVector3d(0, 0, 0), {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}}));
  patches[1].place = "m.obj:9: patch 1";
  testing::expect_error<UnsupportedTopology>([&] { patch_model(patches); }, {"m.obj:9: patch 1", "without area"});
}

TEST(SurfaceIntegrals, OfASphereAreThoseFromAnyApex) {
  const SplineModel sphere = testing::nurbs_sphere();
  const auto of = [&](const Eigen::RowVector3d& apex) {
    return surface_integrals(sphere.surfaces[0], sphere.columns[0], sphere.coordinates, apex);
  };
  const double area = 4 * std::numbers::pi, nodes = 1000, distance = 8;
  EXPECT_NEAR(of({0, 0, 0}).area, area, rounding(nodes, area));
  EXPECT_NEAR(of({0, 0, 0}).volume, area / 3, rounding(nodes, area));
  EXPECT_NEAR(of({7, -3, 2}).volume, area / 3, rounding(nodes, area * distance));
}

}  // namespace
}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/gallery/cages.h"

namespace sublimit::testing {
namespace {

using namespace gallery;
using Eigen::Vector3d;

constexpr double few = 1e-13;  // sums of some hundred terms of size 1

Topology topology(const Mesh& mesh) { return Topology(view(mesh)); }

/// An icosahedron cut four ways `times` times, every point moved to the sphere.
Mesh sphere(int times, double radius) {
  Mesh mesh = icosahedron();
  const std::vector<Level> levels =
      refine(find_scheme("butterfly", {{"tension", "0"}}).value(), mesh, times);  // midpoints
  const Topology& t = levels.back().topology();
  mesh.positions = refinement_matrix(levels) * mesh.positions;
  mesh.positions = radius * mesh.positions.rowwise().normalized();
  mesh.face_sizes.assign(size_t(t.num_faces()), 3);
  mesh.face_vertices.clear();
  for (Index f = 0; f < t.num_faces(); ++f)
    for (const Index v : t.vertices(Face{f})) mesh.face_vertices.push_back(v);
  return mesh;
}

TEST(GalleryCages, AreClosedAndWoundOutwards) {
  for (const Cage& cage : cages()) {
    SCOPED_TRACE(cage.name);
    const Topology t = topology(cage.mesh);
    EXPECT_TRUE(t.faults().empty());
    EXPECT_EQ(t.num_vertices() - t.num_edges() + t.num_faces(), 2);
    for (Index e = 0; e < t.num_edges(); ++e) EXPECT_FALSE(t.is_boundary(Edge{e}));
    EXPECT_GT(volume(t, cage.mesh.positions), 0);
    EXPECT_LT(cage.mesh.positions.colwise().sum().norm(), few);
  }
}

TEST(GalleryCages, HaveTheSymmetriesOfTheirSolids) {
  for (const Cage& cage : cages()) {
    SCOPED_TRACE(cage.name);
    const std::vector<Eigen::Matrix3d> maps = symmetries(cage.mesh.positions);
    EXPECT_EQ(maps.size(), cage.name == "tetrahedron" ? 24u : 48u);
    // A cage in triangles has them too: it is the same solid.
    EXPECT_LT(symmetry_defect(topology(cage.mesh), cage.mesh.positions, maps), few);
  }
  EXPECT_DOUBLE_EQ(diameter(cube().positions), 2 * std::sqrt(3.));
}

TEST(GalleryMeasures, VolumesOfSolids) {
  EXPECT_NEAR(volume(topology(cube()), cube().positions), 8, 8 * few);
  EXPECT_NEAR(volume(topology(triangulated(cube())), cube().positions), 8, 8 * few);
  for (const Cage& cage : cages()) {
    const double expected = cage.name == "tetrahedron" ? 8 / 3. : 8;  // every other corner of a cube like it
    EXPECT_NEAR(volume(topology(cage.mesh), cage.mesh.positions), expected, 8 * few) << cage.name;
  }
  Mesh moved = cube();
  moved.positions.rowwise() += Eigen::RowVector3d(5, -3, 1);  // the volume does not depend on where the origin is
  EXPECT_NEAR(volume(topology(moved), moved.positions), 8, 100 * few);
}

TEST(GalleryMeasures, BendingEnergyOfASphereIsOneAtAnySize) {
  double last = 0;
  for (const int times : {2, 3}) {
    const double off = std::abs(bending_energy(topology(sphere(times, 1)), sphere(times, 1).positions) - 1);
    EXPECT_LT(off, .03);
    EXPECT_TRUE(times == 2 || off < last / 3) << off << " after " << last;  // of second order
    last = off;
  }
  const Mesh ball = sphere(2, 1), large = sphere(2, 1000);
  EXPECT_NEAR(bending_energy(topology(ball), ball.positions), bending_energy(topology(large), large.positions), few);
}

TEST(GalleryMeasures, BendingEnergyOfATorusIsItsClosedForm) {
  // Radii R = 2 and r = 1: integral of H^2 is pi^2 c^2 / sqrt(c^2 - 1), c = R/r (Willmore 1965).
  const Index m = 96, n = 48;
  Mesh mesh = torus(m, n);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / m, v = 2 * std::numbers::pi * j / n, r = 2 + std::cos(v);
      mesh.positions.row(i * n + j) << r * std::cos(u), r * std::sin(u), std::sin(v);
    }
  const double exact = std::numbers::pi * 4 / std::sqrt(3.) / 4;
  EXPECT_NEAR(bending_energy(topology(mesh), mesh.positions), exact, .005 * exact);
}

TEST(GalleryMeasures, BendingEnergyOfACubeGrowsWithTheLevel) {
  const std::vector<Level> levels = refine(find_scheme("bilinear").value(), cube(), 4);
  const SparseMatrix P4 = refinement_matrix(levels);
  const double fine = bending_energy(levels[4].topology(), P4 * cube().positions);
  const double coarse =
      bending_energy(levels[3].topology(), P4.topRows(levels[3].topology().num_vertices()) * cube().positions);
  EXPECT_GT(fine, 1.8 * coarse);  // an edge bends the same angle within half the width
}

TEST(GalleryMeasures, DistancesToASurface) {
  const Mesh outer = cube();
  const SurfaceDistance to_cube(topology(outer), outer.positions);
  EXPECT_NEAR(to_cube({0, 0, 0}), 1, few);
  EXPECT_NEAR(to_cube({2, 0.3, -0.2}), 1, few);              // over a face
  EXPECT_NEAR(to_cube({2, 2, 0.5}), std::sqrt(2.), few);     // over an edge
  EXPECT_NEAR(to_cube({-3, 3, 3}), 2 * std::sqrt(3.), few);  // over a corner
  EXPECT_NEAR(to_cube({0.25, 0.5, -0.5}), 0.5, few);
  EXPECT_LE(to_cube({2, 0, 0}, 1.5), 1.5);
  Mesh inner = cube();
  inner.positions *= .75;
  const Distances d = distances(topology(inner), inner.positions, to_cube);
  EXPECT_NEAR(d.mean, .25, few);
  EXPECT_NEAR(d.max, .25, few);
}

TEST(GalleryMeasures, TheTreeFindsWhatASearchOfAllTrianglesFinds) {
  const Mesh mesh = sphere(2, 1);
  const Topology all = topology(mesh);
  const SurfaceDistance tree(all, mesh.positions);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (int i = 0; i < 50; ++i) {
    const Vector3d p(coordinate(random), coordinate(random), coordinate(random));
    double least = 10;
    for (Index f = 0; f < all.num_faces(); ++f) {
      Mesh one;
      one.positions = mesh.positions;
      one.face_sizes = {3};
      const auto corners = all.vertices(Face{f});
      one.face_vertices.assign(corners.begin(), corners.end());
      least = std::min(least, SurfaceDistance(topology(one), one.positions)(p));
    }
    EXPECT_DOUBLE_EQ(tree(p), least);
  }
}

TEST(GalleryMeasures, SymmetryDefectIsTheDistanceOfAPointThatIsMoved) {
  Mesh mesh = cube();
  const std::vector<Eigen::Matrix3d> maps = symmetries(mesh.positions);
  EXPECT_LT(symmetry_defect(topology(mesh), mesh.positions, maps), few);
  mesh.positions.row(7) *= 1.1;
  const double moved = .1 * std::sqrt(3.);
  EXPECT_NEAR(symmetry_defect(topology(mesh), mesh.positions, maps), moved, few);
}

}  // namespace
}  // namespace sublimit::testing

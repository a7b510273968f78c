// SPDX-License-Identifier: Apache-2.0
// Triangles of classical patches: within the proved distance, closed where the patches are, on spheres, tori, pipes,
// the teapot, and triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "meshes/construction_data.h"
#include "meshes/free_form_shapes.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/triangle_checks.h"

namespace sublimit::testing {
namespace {

Patches patches_of(const RationalShape& shape) {
  return {PatchSet({std::make_shared<const SplineSurface>(shape.surface)}, Coordinates::homogeneous), shape.columns};
}
Patches patches_of(const FreeForm& shapes) {
  FreeFormPatches found = free_form_patches(shapes, "shapes");
  return {std::move(found.patches), std::move(found.columns)};
}

double diagonal_of(const Patches& patches) {
  const Points points = points_in_space(patches.points());
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

double largest_distance(const Tessellation& t, const Patches& patches) {
  return testing::largest_distance(t, patches.faces().triangles,
                                   [&](const std::vector<Place>& at) { return patches.evaluate(at).position; });
}

void expect_within_the_bound(const Patches& patches, double part) {
  const double chord = part * diagonal_of(patches);
  const Tessellation t = tessellate(patches, {.chord = chord});
  ASSERT_FALSE(t.triangles.empty());
  EXPECT_LE(t.bound, chord);
  const double distance = largest_distance(t, patches);
  EXPECT_LE(distance, t.bound + other_route * diagonal_of(patches));
  EXPECT_GT(distance, t.bound / 100);  // a bound of much more would be of no use
}

TEST(PatchTessellation, KeepsItsDistance) {
  const std::vector<Patches> all{
      patches_of(unit_sphere()), patches_of(torus()),           patches_of(pipe()),
      patches_of(teapot()),      patches_of(elevated(torus())), patches_of(elevated(pipe()))};
  for (size_t k = 0; k < all.size(); ++k)
    for (const double part : {0.1, 0.01, 0.001}) {
      SCOPED_TRACE(std::to_string(k) + " " + std::to_string(part));
      expect_within_the_bound(all[k], part);
    }
}

// Products of three polynomials of degree 9 have binomial coefficients that 32-bit integers do not hold.
TEST(PatchTessellation, KeepsItsDistanceInHighDegrees) {
  RationalShape shape = torus();
  while (shape.surface.u().degree() < 9) shape = elevated(shape);
  const Patches patches = patches_of(shape);
  for (const double part : {0.1, 0.01}) expect_within_the_bound(patches, part);
}

// The poles of a sphere are one point each, and periods close: a sphere has the Euler characteristic 2, a torus 0. A
// pipe is open at its ends.
TEST(PatchTessellation, IsClosedWherePatchesAre) {
  for (const double part : {0.2, 0.03, 0.002}) {
    SCOPED_TRACE(part);
    const auto of = [&](const RationalShape& shape) {
      const Patches patches = patches_of(shape);
      return TriangleEdges(tessellate(patches, {.chord = part * diagonal_of(patches)}));
    };
    const TriangleEdges sphere = of(unit_sphere()), ring = of(torus()), tube = of(pipe());
    for (const TriangleEdges* edges : {&sphere, &ring, &tube}) EXPECT_TRUE(edges->is_manifold());
    EXPECT_EQ(sphere.open(), 0);
    EXPECT_EQ(sphere.euler, 2);
    EXPECT_EQ(ring.open(), 0);
    EXPECT_EQ(ring.euler, 0);
    EXPECT_GT(tube.open(), 0);
    EXPECT_EQ(tube.euler, 0);
  }
}

// Two bilinear patches that are told apart by the order of their sides alone: whichever way round, one edge is common.
TEST(PatchTessellation, SidesAreOneWhicheverWayRound) {
  const auto flat = std::make_shared<const SplineSurface>(bezier_knots<double>(1), bezier_knots<double>(1));
  const Points left{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {1, 1, 0}};
  const Points right{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 1}};
  const auto turned = [&](int times) {  // a quarter turn: u runs along what was v
    Points points = right;
    for (int k = 0; k < times; ++k) {
      const Points before = points;
      points << before.row(1), before.row(3), before.row(0), before.row(2);
    }
    return points;
  };
  for (int times = 0; times < 4; ++times) {
    SCOPED_TRACE(times);
    Points both(8, 3);
    both << left, turned(times);
    const Tessellation t = tessellate(Patches(PatchSet({flat, flat}), both), {.chord = 0.01});
    const std::set<Index> vertices = [&] {
      std::set<Index> used;
      for (const auto& triangle : t.triangles) used.insert(triangle.vertices.begin(), triangle.vertices.end());
      return used;
    }();
    std::set<std::array<double, 3>> points;
    for (const Index v : vertices) points.insert({t.points(v, 0), t.points(v, 1), t.points(v, 2)});
    EXPECT_EQ(points.size(), vertices.size());  // no point twice
    EXPECT_EQ(TriangleEdges(t).euler, 1);       // one sheet
  }
}

// A limit surface of bicubic B-splines and the same surface as patches: the same cells and bounds.
TEST(PatchTessellation, IsThatOfTheLimitWhichIsTheSameSurface) {
  std::mt19937 random(5);
  Mesh grid;
  const Index n = 6;
  grid.positions = random_points(random, n * n, 3);
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = j * n + i;
      grid.face_sizes.push_back(4);
      for (const Index v : {a, a + 1, a + n + 1, a + n}) grid.face_vertices.push_back(v);
    }
  grid.boundary = Boundary::none;  // faces at the border are holes: what is left is the B-spline of uniform knots
  const auto spline = std::make_shared<const SplineSurface>(uniform_knots(3, n), uniform_knots(3, n));
  const Patches patches(PatchSet({spline}), grid.positions);
  const double chord = 0.01;
  const Tessellation of_limit = tessellate(LimitSurface(grid, "catmull-clark"), {.chord = chord});
  const Tessellation of_patches = tessellate(patches, {.chord = chord});
  EXPECT_EQ(of_limit.triangles.size(), of_patches.triangles.size());
  EXPECT_EQ(of_limit.places.size(), of_patches.places.size());
  EXPECT_NEAR(of_limit.bound, of_patches.bound, other_route);
}

// Corners that are each the same as the next, and lead away: spans below what counts as the same, and an apex that
// moves.
TEST(PatchTessellation, CornersStayWhereTheyAre) {
  const Index spans = 20000;
  std::vector<double> knots{0};
  for (Index i = 0; i <= spans; ++i) knots.push_back(double(i));
  knots.push_back(double(spans));
  const auto strip =
      std::make_shared<const SplineSurface>(Knots<double>::open(1, spans + 1, knots), bezier_knots<double>(1));
  Points points(2 * (spans + 1), 3);
  for (Index j = 0; j < 2; ++j)
    for (Index i = 0; i <= spans; ++i) points.row(j * (spans + 1) + i) << 18. * i / spans, 5. * j, 0;
  const Tessellation flat = tessellate(Patches(PatchSet({strip}), points), {.chord = 1});
  double area = 0;
  for (const auto& t : flat.triangles) {
    const auto at = [&](size_t k) { return Eigen::Vector3d(flat.points.row(t.vertices[k])); };
    area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  constexpr double flattened = 1e-12;  // a plane: rounding of 40000 triangles
  EXPECT_NEAR(area, 90, 90 * flattened);
  EXPECT_LE(flat.bound, 1);

  const Index blades = 3000;
  const auto blade = std::make_shared<const SplineSurface>(bezier_knots<double>(1), bezier_knots<double>(1));
  Points fan(4 * blades, 3);
  for (Index k = 0; k < blades; ++k) {
    const auto rim = [&](Index i) {
      return Eigen::RowVector3d(std::cos(0.002 * double(i)), std::sin(0.002 * double(i)), 0);
    };
    const Eigen::RowVector3d apex(0, 0, 0.9e-6 * double(k));
    fan.middleRows(4 * k, 4) << apex, rim(k), apex, rim(k + 1);
  }
  const Patches patches(PatchSet(std::vector<std::shared_ptr<const Patch>>(size_t(blades), blade)), fan);
  const Tessellation t = tessellate(patches, {.chord = 0.002});
  EXPECT_LE(t.bound, 0.002);
  EXPECT_LE(largest_distance(t, patches), t.bound);
}

// However large the distance, what is closed has triangles, and they are closed.
TEST(PatchTessellation, HasTrianglesHoweverLargeTheChord) {
  for (const RationalShape& shape : {unit_sphere(), torus()}) {
    const TriangleEdges edges(tessellate(patches_of(shape), {.chord = 1e4}));
    EXPECT_GT(edges.directed.size(), 0u);
    EXPECT_EQ(edges.open(), 0);
  }
  // One face around a cylinder: its side ends where it begins.
  const auto around = std::make_shared<const SplineSurface>(Knots<double>::open(3, 4, {0, 0, 0, 0, 1, 1, 1, 1}),
                                                            bezier_knots<double>(1));
  Points loop(8, 3);
  for (Index j = 0; j < 2; ++j) {
    loop.row(4 * j) << 0, 0, j;
    loop.row(4 * j + 1) << 3, 2, j;
    loop.row(4 * j + 2) << -3, 2, j;
    loop.row(4 * j + 3) << 0, 0, j;
  }
  const TriangleEdges tube(tessellate(Patches(PatchSet({around}), loop), {.chord = 100}));
  EXPECT_GT(tube.directed.size(), 0u);
  EXPECT_EQ(tube.euler, 0);
}

TEST(PatchTessellation, TrianglesToo) {
  std::mt19937 random(2);
  const auto patch = std::make_shared<const TrianglePatch>(3);
  const Patches patches(PatchSet({patch}), random_points(random, patch->num_points(), 3));
  for (const double part : {0.1, 0.003}) expect_within_the_bound(patches, part);
}

TEST(PatchTessellation, NormalsOfACellAreWithinTheAngle) {
  const Patches patches = patches_of(unit_sphere());
  const double angle = 0.2, chord = 0.3;
  const Tessellation t = tessellate(patches, {.chord = chord, .angle = angle, .normals = true});
  EXPECT_GT(t.cells, tessellate(patches, {.chord = chord}).cells);
  for (Index k = 0; k < std::ssize(t.triangles); ++k)
    for (int c = 0; c < 3; ++c) {
      const auto at = [&](int corner) {
        return Eigen::RowVector3d(t.points.row(t.triangles[size_t(k)].vertices[size_t(corner % 3)]));
      };
      const Eigen::RowVector3d n = t.normals.row(3 * k + c), next = t.normals.row(3 * k + (c + 1) % 3);
      EXPECT_LE((n - at(c).normalized()).norm(), found_distance);
      const bool at_pole = std::abs(at(c)[2]) > 0.9;  // cells there may be as large as the chord
      if (!at_pole) {
        EXPECT_LE((n - next).norm(), angle);
      }
    }
}

TEST(PatchTessellation, SaysWhatItCannot) {
  const Patches patches = patches_of(unit_sphere());
  expect_error<InvalidParameter>([&] { (void)tessellate(patches, {.chord = 0}); }, {"the chord is 0"});
  expect_error<InvalidParameter>([&] { (void)tessellate(patches, {.chord = 0.1, .rates = {1}}); },
                                 {"rates are of the edges of a mesh"});
  expect_error<InvalidParameter>([&] { (void)tessellate(patches, {.chord = 1e-30}); }, {"rounded"});
  RationalShape with_pole = pipe();
  with_pole.columns.row(4) *= -1;
  expect_error<UnsupportedTopology>([&] { (void)tessellate(patches_of(with_pole), {.chord = 0.1}); },
                                    {"face 1, of patch 0", "denominator", "sample --grid"});
  expect_error<ResourceError>([&] { (void)tessellate(patches, {.chord = 1e-3, .max_triangles = 10}); },
                              {"more than 10 triangles"});
}

}  // namespace
}  // namespace sublimit::testing

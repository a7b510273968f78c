// SPDX-License-Identifier: Apache-2.0
// Control meshes of level sets: nearness, topology, sharp edges, bad input.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sublimit/implicit/detail/combinations.h"
#include "sublimit/implicit/detail/level_set_mesh.h"
#include "sublimit/implicit/polygonize/polygonize.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

LevelSetMesh made(const FieldPointer& field, const std::string& scheme, const LevelSetOptions& options = {}) {
  return level_set_mesh(field, find_scheme(scheme).value(), polygonize, options);
}

TEST(LevelSetMesh, SphereToOneThousandth) {
  const FieldPointer sphere = sphere_field({.1, .2, .3}, 1);
  constexpr double asked = 1e-3;
  const LevelSetMesh mesh = made(sphere, "catmull-clark", {.tolerance = asked});
  EXPECT_TRUE(mesh.met());
  EXPECT_EQ(closed_mesh_counts(mesh.cage), (ClosedMeshCounts{.euler = 2, .components = 1}));
  EXPECT_EQ(mesh.counts, mesh.fine_counts);
  // Measured again, by another grid and by the sphere itself.
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh.cage);
  const LimitSamples samples = surface.evaluate(mesh.cage.positions, surface.grid(11), 1);
  for (Eigen::Index i = 0; i < samples.position.rows(); ++i) {
    const Vector3d x = samples.position.row(i).transpose() - Vector3d(.1, .2, .3);
    EXPECT_NEAR(x.norm(), 1, asked);
    EXPECT_GT(Vector3d(samples.normal.row(i)).dot(x), 0);  // outside is outside
  }
}

TEST(LevelSetMesh, BoxIsExactWithCreases) {
  const LevelSetMesh mesh = made(box_field({0, 0, 0}, {1, .7, .5}), "catmull-clark");
  EXPECT_EQ(mesh.cage.corners.size(), 8u);
  EXPECT_GE(mesh.cage.creases.size(), 12u);
  // Places are moved to the planes until they are nearer than 1e-10 of a cell, and control points are their
  // combinations.
  constexpr double moved = 1e-9;
  EXPECT_LE(mesh.attempt.error.largest, moved);
  EXPECT_EQ(mesh.counts.euler, 2);
}

/// Nearness measured again at other places, shape and winding of the cage.
LevelSetMesh expect_near(const FieldPointer& field, const std::string& scheme, const ClosedMeshCounts& counts,
                         Index most_faces, const LevelSetOptions& options = {}) {
  SCOPED_TRACE(scheme);
  const LevelSetMesh mesh = made(field, scheme, options);
  EXPECT_TRUE(mesh.met());
  if (options.tolerance == 0) {
    EXPECT_EQ(mesh.tolerance, 1e-4 * (options.box ? options.box->diagonal().norm() : mesh.diagonal));
  }
  EXPECT_EQ(closed_mesh_counts(mesh.cage), counts);
  EXPECT_EQ(mesh.counts, mesh.fine_counts);
  EXPECT_LE(mesh.cage.num_faces(), most_faces);
  const LimitMap surface(find_scheme(scheme).value(), mesh.cage);
  const LimitSamples samples = surface.evaluate(mesh.cage.positions, surface.grid(5), 1);
  for (Eigen::Index i = 0; i < samples.position.rows(); ++i) {
    const FieldJet jet = field->jet(samples.position.row(i));
    EXPECT_LE(std::abs(jet.value), 1.05 * mesh.tolerance * jet.gradient.norm());
    // Places on creases have the normal of their face's side, and the field the gradient of either.
    if (samples.status[size_t(i)] == LimitStatus::crease) continue;
    EXPECT_GT(Vector3d(samples.normal.row(i)).dot(jet.gradient), 0);
  }
  return mesh;
}

FieldPointer part_with_hole() {
  return difference_field({box_field({0, 0, 0}, {1, 1, .5}), distance_to_line({0, 0, 0}, {0, 0, 1}, .5)});
}
/// A quartic of genus 5.
FieldPointer tangle() {
  return polynomial_field(
      {{1, 4, 0, 0}, {-5, 2, 0, 0}, {1, 0, 4, 0}, {-5, 0, 2, 0}, {1, 0, 0, 4}, {-5, 0, 0, 2}, {11.8, 0, 0, 0}});
}
AlignedBox3d box_of_tangle() { return {Vector3d(-3, -3, -3), Vector3d(3, 3, 3)}; }
std::vector<FieldPointer> capsules() {
  const Vector3d joints[] = {{0, 0, 0}, {1, 0, 0}, {1.6, .8, 0}, {1.6, .8, 1}};
  std::vector<FieldPointer> chain;
  for (int i = 0; i < 3; ++i) chain.push_back(distance_to_segment(joints[i], joints[i + 1], .35));
  return chain;
}

TEST(LevelSetMesh, PartHasCreasesAroundItsHole) {
  for (const auto& [scheme, faces] : {std::pair{"catmull-clark", 200}, {"loop", 1296}}) {
    const LevelSetMesh mesh = expect_near(part_with_hole(), scheme, {.euler = 0, .components = 1}, faces);
    EXPECT_EQ(mesh.cage.corners.size(), 8u);
    // Creases are closed curves, but for those that end at corners: 12 edges of the box and both rims of the hole.
    std::vector<int> ends(size_t(mesh.cage.num_vertices()), 0);
    double length = 0;
    for (const Mesh::Crease& crease : mesh.cage.creases) {
      ++ends[size_t(crease.tail)], ++ends[size_t(crease.head)];
      length += (mesh.cage.positions.row(crease.tail) - mesh.cage.positions.row(crease.head)).norm();
    }
    EXPECT_EQ(std::ranges::count(ends, 3), 8);
    EXPECT_EQ(std::ranges::count(ends, 1), 0);
    EXPECT_EQ(std::ranges::count_if(ends, [](int n) { return n > 3; }), 0);
    // Control polygons of circles are a little longer than these.
    const double edges = 8 * 2 + 4 * 1, rims = 2 * 2 * 3.14159265358979 * .5;
    EXPECT_NEAR(length, edges + rims, .05 * rims);
  }
}

TEST(LevelSetMesh, TangleHasFiveHandles) {
  expect_near(tangle(), "catmull-clark", {.euler = -8, .components = 1}, 1056,
              {.box = box_of_tangle(), .tolerance = 2e-3});
  expect_near(tangle(), "loop", {.euler = -8, .components = 1}, 2112, {.box = box_of_tangle(), .tolerance = 1e-2});
}

TEST(LevelSetMesh, CapsulesAreOneChain) {
  expect_near(smooth_union_field(capsules(), .2), "catmull-clark", {.euler = 2, .components = 1}, 792,
              {.tolerance = 1e-3});
}

/// Four control points may be all at one point of a surface, and the limit is nowhere far from it.
TEST(LevelSetMesh, WhatIsFoldedDoesNotMeetATolerance) {
  const LevelSetMesh mesh =
      made(union_field(capsules()), "catmull-clark", {.cells = 5, .tolerance = 1, .most_faces = 200});
  ASSERT_GT(mesh.attempts.front().error.largest_angle, folded_angle);
  EXPECT_LE(mesh.attempts.front().error.largest, 1);
  EXPECT_EQ(mesh.met(), !mesh.attempt.error.is_folded());
  EXPECT_TRUE(mesh.attempts.size() > 1 || !mesh.met());
  if (!mesh.met()) {
    EXPECT_NE(mesh.notes.back().find("folded"), std::string::npos) << mesh.notes.back();
  }
}

TEST(LevelSetMesh, InterpolatingSchemesGoThroughTheirControlPoints) {
  constexpr double asked = 1e-2;
  const FieldPointer ball = sphere_field({0, 0, 0}, 1);
  for (const char* scheme : {"modified-butterfly", "kobbelt"}) {
    const LevelSetMesh mesh = expect_near(ball, scheme, {.euler = 2, .components = 1}, 48, {.tolerance = asked});
    for (Index v = 0; v < mesh.cage.num_vertices(); ++v)
      EXPECT_NEAR(mesh.cage.positions.row(v).norm(), 1, 1.05 * asked);
  }
}

TEST(LevelSetMesh, TorusHasOneHole) {
  expect_near(distance_to_circle({0, 0, 0}, {0, 0, 1}, 1, .4), "catmull-clark", {.euler = 0, .components = 1}, 768);
}

TEST(LevelSetMesh, BallsThatMergeAreOne) {
  const FieldPointer balls = metaballs_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1}, {{.4, .8, 0}, 1, 1}});
  expect_near(balls, "catmull-clark", {.euler = 2, .components = 1}, 608, {.tolerance = 5e-4});
  expect_near(balls, "loop", {.euler = 2, .components = 1}, 1216, {.tolerance = 1e-3});
}

TEST(LevelSetMesh, IsRoundedWhereASchemeHasNoCreases) {
  const LevelSetMesh mesh =
      made(box_field({0, 0, 0}, {1, 1, 1}), "doo-sabin", {.cells = 6, .tolerance = 1, .rounds = 1});
  EXPECT_TRUE(mesh.cage.creases.empty());
  ASSERT_FALSE(mesh.notes.empty());
  EXPECT_NE(mesh.notes[0].find("rounded"), std::string::npos) << mesh.notes[0];
}

TEST(Polygonize, HasTheRightEulerCharacteristic) {
  const FieldPointer quartic = tangle();
  const FieldPointer balls = metaballs_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1}});
  const FieldPointer apart = union_field({sphere_field({-1.5, 0, 0}, 1), sphere_field({1.5, 0, 0}, 1)});
  const FieldPointer part = part_with_hole();
  for (const int cells : {12, 16, 24}) {
    const auto counts = [&](const FieldPointer& field) {
      const FieldGrid grid =
          sample_field(*field, field == quartic ? box_of_tangle() : padded_extent(*field, cells), cells);
      Mesh mesh = polygonize(grid);
      EXPECT_EQ(split_pinches(mesh), 0);
      double volume = 0;  // positive: faces are wound counter-clockwise from outside
      for (Index f = 0; f < mesh.num_faces(); ++f)
        for (const int k : {1, 2}) {
          const auto at = [&](int i) { return Vector3d(mesh.positions.row(mesh.face_vertices[size_t(4 * f + i)])); };
          volume += at(0).dot(at(k).cross(at(k + 1))) / 6;
        }
      EXPECT_GT(volume, 0);
      return closed_mesh_counts(mesh);
    };
    EXPECT_EQ(counts(sphere_field({0, 0, 0}, 1)), (ClosedMeshCounts{2, 1}));
    EXPECT_EQ(counts(distance_to_circle({0, 0, 0}, {0, 0, 1}, 1, .4)), (ClosedMeshCounts{0, 1}));
    EXPECT_EQ(counts(quartic), (ClosedMeshCounts{-8, 1}));  // genus 5
    EXPECT_EQ(counts(balls), (ClosedMeshCounts{2, 1}));
    EXPECT_EQ(counts(apart), (ClosedMeshCounts{4, 2}));
    EXPECT_EQ(counts(part), (ClosedMeshCounts{0, 1}));
  }
}

TEST(ClosedMesh, SplitsPinchesAndRefusesTheRest) {
  Mesh two;  // tetrahedra with a corner in common
  two.positions = Points::Random(7, 3);
  two.face_vertices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 0, 5, 4, 0, 4, 6, 4, 5, 6, 0, 6, 5};
  two.face_sizes.assign(8, 3);
  expect_error<InvalidMesh>([&] { closed_mesh_counts(two); }, {"no manifold", "vertex 0"});
  EXPECT_EQ(split_pinches(two), 1);
  EXPECT_EQ(two.num_vertices(), 8);
  EXPECT_EQ(closed_mesh_counts(two), (ClosedMeshCounts{4, 2}));
  two.face_sizes.pop_back();
  two.face_vertices.resize(21);
  expect_error<InvalidMesh>([&] { closed_mesh_counts(two); }, {"open at the edge"});
}

TEST(FieldGrid, SaysWhatIsWrong) {
  const FieldPointer sphere = sphere_field({0, 0, 0}, 1);
  const AlignedBox3d box(Vector3d(-2, -2, -2), Vector3d(2, 2, 2));
  const AlignedBox3d aside(Vector3d(4, 4, 4), Vector3d(5, 5, 5)), tight(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  expect_error<InvalidParameter>([&] { sample_field(*sphere, aside, 8); }, {"no change of sign", "between 47 and 74"});
  expect_error<InvalidParameter>([&] { sample_field(*sphere, tight, 8); }, {"touches the rim", "make the box larger"});
  expect_error<InvalidParameter>([&] { sample_field(*offset_field(sphere, 100), box, 8); }, {"no change of sign"});
  expect_error<InvalidParameter>(
      [&] {
        sample_field(*sphere_field({.25, .25, .25}, .05), box, 8);
      },
      {"thinner than a cell", "take more cells"});
  expect_error<InvalidParameter>([&] { sample_field(*sphere, box, 3); }, {"3 cells", "4 or more"});
  expect_error<InvalidParameter>([&] { sample_field(*sphere, AlignedBox3d(), 8); }, {"has no inside"});
  expect_error<ResourceError>([&] { sample_field(*sphere, box, 100'000); },
                              {"100000 x 100000 x 100000", "fewer cells"});
  const FieldPointer hole = callback_field(
      [](const Vector3d& x) { return FieldJet(x.norm() < 1 ? std::numeric_limits<double>::quiet_NaN() : 1); });
  expect_error<InvalidParameter>([&] { sample_field(*hole, box, 8); }, {"the field is nan at ("});
  expect_error<InvalidParameter>([&] { padded_extent(*distance_to_line({0, 0, 0}, {1, 0, 0}, 1), 8); }, {"give a box"});
  expect_error<InvalidParameter>([&] { made(sphere, "loop", {.tolerance = -1}); }, {"the tolerance is -1"});
}

}  // namespace
}  // namespace sublimit::testing

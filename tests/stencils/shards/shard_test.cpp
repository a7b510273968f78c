// SPDX-License-Identifier: Apache-2.0
// Tables in parts make each point of the whole once, with the same bits.
#include "sublimit/stencils/shards/shard.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

struct Case {
  const char* scheme;
  Mesh mesh;
};
std::vector<Case> cases() {
  Mesh creased = torus(8, 6);
  add_crease(creased, {0, 6, 12, 18}, {10, 2.5f, 1.5f});
  Mesh open = jittered(grid(7, 6));
  open.holes = {5};
  return {{"catmull-clark", torus(9, 7)}, {"catmull-clark", creased},        {"catmull-clark", open},
          {"loop", triangle_torus(7, 6)}, {"loop", jittered(icosahedron())}, {"butterfly", triangle_torus(7, 6)}};
}

/// Points of a table of all, by face and row of its lattice.
struct Whole {
  Baked baked;
  std::vector<double> points;
};
Whole whole_of(const Scheme<double>& scheme, const Mesh& mesh, const BakeRequest& request) {
  Patterns patterns(scheme);
  std::optional<Baked> baked =
      bake_by_patterns(patterns, control_level(scheme, mesh, {}), request, {.owners = OwnerRule::first});
  Whole whole{std::move(baked.value()), {}};
  const Points x = mesh.positions;
  std::vector<double> in;
  for (Eigen::Index i = 0; i < x.rows(); ++i) in.insert(in.end(), {x(i, 0), x(i, 1), x(i, 2)});
  whole.points.resize(size_t(3 * whole.baked.table.table.num_points()));
  whole.baked.table.table.apply(in, 3, whole.points);
  return whole;
}

void expect_parts(const Case& c, const BakeRequest& request, int num_parts) {
  const Scheme<double> scheme = find_scheme(c.scheme).value();
  const Whole whole = whole_of(scheme, c.mesh, request);
  const FaceLattices& lattices = *whole.baked.table.lattices;
  const Topology t(view(c.mesh));
  std::mt19937 random(3);
  std::vector<int> owner(size_t(c.mesh.num_faces()));
  for (int& o : owner) o = int(random() % unsigned(num_parts));
  std::vector<int> times(size_t(whole.baked.table.table.num_points()), 0);
  for (int part = 0; part < num_parts; ++part) {
    Patterns patterns(scheme);
    const MeshPart own = mesh_part(c.mesh, t, owner, part, shard_rings(patterns, Creasing::uniform));
    const Shard shard = bake_shard(patterns, own, request, shard_method(patterns, request, true));
    ASSERT_EQ(std::ssize(shard.inputs), shard.table.table.num_control_points());
    std::vector<double> in, made(size_t(3 * shard.table.table.num_points()));
    for (const std::int64_t v : shard.inputs)
      for (int k = 0; k < 3; ++k) in.push_back(c.mesh.positions(v, k));
    shard.table.table.apply(in, 3, made);
    std::int64_t count = 0;
    std::vector<std::int64_t> first(shard.table.table.arrays().patch_points.begin(),
                                    shard.table.table.arrays().patch_points.end());
    ASSERT_GE(first.size(), shard.patches.size());
    for (size_t p = 0; p < shard.patches.size(); ++p) {
      const PatchPlace& patch = shard.patches[p];
      auto at = size_t(first[p]);
      for (const std::int32_t row : LatticeRanks::rows(lattices.lattice(), patch.share)) {
        // The same point in the whole: there faces may lie turned in another way.
        ASSERT_LT(size_t(patch.face), own.faces.size());
        const std::int64_t point = lattices.point(static_cast<std::int32_t>(own.faces[size_t(patch.face)]), row);
        ++times[size_t(point)];
        for (size_t k = 0; k < 3; ++k)
          EXPECT_EQ(made[3 * at + k], whole.points[3 * size_t(point) + k]) << c.scheme << " part " << part;
        ++at, ++count;
      }
    }
    EXPECT_EQ(count, shard.table.table.num_points());
  }
  for (const int count : times) EXPECT_EQ(count, 1);
}

TEST(Shards, MakeEachPointOnceWithTheBitsOfTheWhole) {
  for (const Case& c : cases())
    for (const int parts : {1, 2, 3, 7}) {
      expect_parts(c, {.rows = TableRows::level, .level = 2}, parts);
      expect_parts(c, {.rows = TableRows::limit, .level = 1}, parts);
    }
}

TEST(Shards, RefuseWhatTheyWouldDivideWrongly) {
  const std::vector<int> owner(30, 0);
  Mesh mesh = torus(6, 5);
  for (const char* name : {"doo-sabin", "mid-edge"}) {
    Patterns patterns(find_scheme(name).value());
    expect_error<InvalidParameter>([&] { shard_method(patterns, {.rows = TableRows::level, .level = 2}, true); },
                                   {name, "dual"});
  }
  mesh.knot_intervals = {{0, 1, 2}};
  expect_error<InvalidMesh>([&] { mesh_part(mesh, Topology(view(mesh)), owner, 0, 1); }, {"knot intervals"});
}

TEST(Shards, MayHaveNoFaces) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  Mesh mesh = cube();
  mesh.positions.conservativeResize(10, 3);
  mesh.positions.bottomRows(2).setConstant(5);
  const std::vector<int> owner(6, 1);
  for (const int part : {0, 2}) {
    Patterns patterns(scheme);
    const MeshPart own = mesh_part(mesh, Topology(view(mesh)), owner, part, 3);
    const Shard shard = bake_shard(patterns, own, {.rows = TableRows::level, .level = 2}, BakeMethod::patterns);
    EXPECT_EQ(shard.table.table.num_points(), part == 0 ? 2 : 0);  // vertices of no face are the first part's
    EXPECT_EQ(std::ssize(shard.inputs), part == 0 ? 2 : 0);
  }
}

}  // namespace
}  // namespace sublimit::testing

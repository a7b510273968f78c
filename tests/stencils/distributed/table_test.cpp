// SPDX-License-Identifier: Apache-2.0
// distributed.h, by a program that has it alone (table_driver.cpp).
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit::testing {
namespace {

struct TableCase {
  const char *name, *scheme, *levels, *rows;
  Mesh mesh;
};

std::vector<TableCase> table_cases() {
  Mesh creased = jittered(torus(7, 5));
  add_crease(creased, {0, 5, 10}, {10, 2.5F});
  creased.corners = {{12, 1.5F}};
  creased.creasing = Creasing::chaikin;
  Mesh open = jittered(grid(5, 4));
  open.holes = {5};
  open.boundary = Boundary::edge_only;
  Mesh mixed = disjoint_union(jittered(prism(5)), jittered(polygon_ring({4, 5, 4, 6})));
  mixed.triangles = Triangles::smooth;
  mixed.positions.conservativeResize(mixed.positions.rows() + 2, 3);  // vertices of no face
  mixed.positions.bottomRows(2) << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  Mesh triangles = jittered(triangle_grid(3, 3));
  triangles.triangles = Triangles::smooth;
  return {{"creased", "catmull-clark", "2", "level", creased},
          {"creased limit", "catmull-clark", "1", "limit", creased},
          {"open", "catmull-clark", "2", "level", open},
          {"mixed", "catmull-clark", "2", "level", mixed},
          {"smooth triangles", "catmull-clark", "1", "level", triangles},
          {"control points' limits", "catmull-clark", "0", "limit", jittered(cube())},
          {"loop", "loop", "2", "level", jittered(triangle_torus(6, 5))},
          {"butterfly limit", "butterfly", "1", "limit", jittered(icosahedron())}};
}

TEST(DistributedTable, IsThatOfOneProcessByAnyNumberOfRanks) {
  for (const TableCase& c : table_cases()) {
    const TemporaryDirectory directory;
    const auto path = [&](const char* name) { return (directory / name).string(); };
    write_mesh(path("m.obj"), c.mesh);
    const std::string words = path("m.obj") + " -s " + c.scheme + " -l " + c.levels +
                              (std::string(c.rows) == "limit" ? " --limit" : "") + " --shards 4 -o " + path("shards");
    ASSERT_EQ(run_ranks(2, "bake " + words).status, 0) << c.name;
    ASSERT_EQ(run_ranks(1, "apply " + path("shards") + " " + path("m.obj") + " -o " + path("s.npy")).status, 0);
    const std::string points = read_file(path("s.npy")).substr(128);  // behind the header
    for (const int ranks : {1, 2, 3}) {
      const RanksRun run = run_ranks(ranks,
                                     "points " + path("m.obj") + " " + c.scheme + " " + c.levels + " " + c.rows + " " +
                                         path("shards") + " " + path("out"),
                                     "", 200, SUBLIMIT_TABLE_DRIVER);
      ASSERT_EQ(run.status, 0) << c.name << " by " << ranks << ": " << run.err;
      EXPECT_EQ(read_file(path("out")) == points, true) << c.name << " by " << ranks;
    }
  }
}

TEST(DistributedTable, WhatOneRankHasWrongIsAnErrorOfAll) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), shards = (directory / "shards").string();
  write_mesh(obj, jittered(torus(5, 4)));
  ASSERT_EQ(run_ranks(2, "bake " + obj + " -s catmull-clark -l 1 -o " + shards).status, 0);
  for (const int ranks : {1, 2, 3}) {
    const RanksRun run = run_ranks(ranks, "errors " + obj + " " + shards, "", 200, SUBLIMIT_TABLE_DRIVER);
    EXPECT_EQ(run.status, 0) << ranks << " ranks: " << run.err;
    const RanksRun fails = run_ranks(ranks, "fails", "", 200, SUBLIMIT_TABLE_DRIVER);
    EXPECT_EQ(fails.status, 2) << fails.err;
    EXPECT_EQ(fails.error(), "sublimit-mpi: error: level -1 of a table; 1 to 11 are right\n") << ranks;
    const RanksRun dies = run_ranks(ranks, "dies", "", 200, SUBLIMIT_TABLE_DRIVER);
    EXPECT_EQ(dies.status, 70) << dies.err;
    EXPECT_EQ(dies.error(), "sublimit-mpi: error: rank " + std::to_string(ranks - 1) + ": no reason\n") << ranks;
  }
}

}  // namespace
}  // namespace sublimit::testing

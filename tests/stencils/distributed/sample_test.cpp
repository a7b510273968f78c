// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi sample`: the bytes of one process.
#include <gtest/gtest.h>

#include <fstream>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "stencils/distributed/tagged_unions.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

/// Few samples are evaluated in another way than many.
void expect_bytes(const std::string& what, const std::string& mesh, const std::string& arguments,
                  std::initializer_list<int> ranks) {
  const TemporaryDirectory directory;
  const std::string one = (directory / "one.csv").string(), many = (directory / "many.csv").string();
  ASSERT_EQ(run_alone("sample " + mesh + arguments + " -o " + one), 0) << what << arguments;
  for (const int n : ranks) {
    const RanksRun run = run_ranks(n, "sample " + mesh + arguments + " -o " + many);
    ASSERT_EQ(run.status, 0) << what << arguments << " by " << n << ": " << run.err;
    EXPECT_EQ(read_file(many) == read_file(one), true) << what << arguments << " by " << n;
    std::filesystem::remove(many);
  }
}

TEST(Sample, WritesTheBytesOfOneProcess) {
  Mesh creased = jittered(torus(7, 5));
  add_crease(creased, {0, 5, 10}, {10, 2.5f});
  add_crease(creased, {10, 11, 12}, {0.7f, 1.3f});
  Mesh open = jittered(grid(6, 5));
  open.holes = {5};
  open.corners = {{0, 1.5f}};
  const Mesh mixed = disjoint_union(jittered(prism(5)), jittered(polygon_ring({4, 5, 4, 6})));
  const Mesh wrapped = disjoint_union(jittered(torus(8, 6)), jittered(torus(3, 5)));
  struct Case {
    const char* name;
    const char* scheme;
    Mesh mesh;
  };
  for (const Case& c : std::initializer_list<Case>{{"creased", "catmull-clark", creased},
                                                   {"extraordinary", "catmull-clark", jittered(fan(5, 4, 3))},
                                                   {"open", "catmull-clark", open},
                                                   {"mixed", "catmull-clark", mixed},
                                                   {"wrapped", "catmull-clark", wrapped},
                                                   {"mixed", "doo-sabin", mixed},
                                                   {"triangles", "loop", jittered(icosahedron())}}) {
    const TemporaryDirectory directory;
    const std::string obj = (directory / "m.obj").string(), scheme = std::string(" -s ") + c.scheme;
    write_obj(obj, c.mesh);
    expect_bytes(c.name, obj, scheme + " --random 50 --derivatives 2 --curvature", {1, 2, 3, 4});
    expect_bytes(c.name, obj, scheme + " --random 3000 --seed 7 --derivatives 2 --curvature", {1, 2, 3, 4});
    expect_bytes(c.name, obj, scheme + " --grid 3 --derivatives 1", {3});
  }
}

TEST(Sample, WritesTheBytesOfOneProcessBatchByBatch) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), csv = (directory / "p.csv").string();
  write_obj(obj, jittered(torus(8, 6)));
  expect_bytes("torus", obj, " -s catmull-clark --random 150001", {2, 3});
  expect_bytes("torus", obj, " -s catmull-clark --random 65536", {1, 2});
  expect_bytes("torus", obj, " -s catmull-clark --random 0", {2});
  std::ofstream(csv) << "face,u,v\n47,0.25,1.5\n3,1,0\n3,0.3,0.7\n0,-0.1,0.5\n20,0.125,0.75\n";
  expect_bytes("torus", obj, " -s catmull-clark --clamp --derivatives 1 --at " + csv, {1, 2, 3, 4});
  std::ofstream(csv) << "face,u,v\n";
  expect_bytes("torus", obj, " -s catmull-clark --at " + csv, {3});
  write_obj(obj, cube());
  expect_bytes("cube", obj, " -s catmull-clark --grid 5 --derivatives 2", {8});  // ranks without faces
}

TEST(Sample, WritesTheBytesOfOneProcessOfTaggedMeshes) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string();
  for (const NamedMesh& mesh : tagged_unions()) {
    write_obj(obj, mesh.mesh);
    expect_bytes(mesh.name, obj, " -s " + mesh.schemes.front() + " --random 20000 --derivatives 2", {2, 3});
  }
}

TEST(Sample, NamesARowThatIsNoPlaceOnce) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), csv = (directory / "p.csv").string(),
                    out = (directory / "o.csv").string();
  write_obj(obj, cube());
  const auto error = [&](const std::string& arguments, int status) {
    const RanksRun run = run_ranks(3, "sample " + obj + " -s catmull-clark " + arguments + " -o " + out);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(directory.num_files(), 2);  // no temporary either
    return run.error();
  };
  std::ofstream(csv) << "face,u,v\n0,0.5,0.5\n6,0.5,0.5\n";
  EXPECT_EQ(error("--at " + csv, 3), "sublimit-mpi: error: " + csv +
                                         ":3: face 6 does not exist; faces are 0 to 5, a quad each or a corner of "
                                         "another polygon\n");
  std::ofstream(csv) << "face,u,v\n0,0.5,1.5\n";
  EXPECT_EQ(error("--at " + csv, 3), "sublimit-mpi: error: " + csv +
                                         ":2: (u, v) = (0.5, 1.5) is outside the square 0 <= u, v <= 1; --clamp moves "
                                         "such places to its rim\n");
  EXPECT_EQ(error("--random 3 --grid 3", 2),
            "sublimit-mpi: error: more than one of --at IN.csv, --grid N and --random N; one of them says where to "
            "sample\n");
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// `bake --face-varying --tags`, then `apply`: the mesh that `refine` writes, in another order, and refining goes on.
#include <gtest/gtest.h>

#include "meshes/face_varying_meshes.h"
#include "meshes/same_mesh.h"
#include "stencils/cli_tables.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Sharp and semi-sharp, with seams.
Mesh tagged() {
  Mesh mesh = with_channel(creased_cube(), {{0, 2}, {2, 3}, {1, 3}, {4, 5}});
  mesh.corners = {{6, 1.5f}};
  return mesh;
}

Mesh open_polygons() {
  Mesh mesh = with_random_channel(jittered(disjoint_union(prism(5), grid(4, 3))), 0.3);
  // They would lie on each other.
  mesh.positions.bottomRows(20).array() += 7;
  mesh.creases = {{0, 1, 3.5f}};
  mesh.boundary = Boundary::edge_only;
  mesh.creasing = Creasing::chaikin;
  return mesh;
}

double tolerance(const Mesh& mesh) { return rounding(40, mesh.positions.cwiseAbs().maxCoeff()); }

TEST(CliBakeChannels, WhatApplyWritesIsWhatRefineWrites) {
  for (const Mesh& mesh : {tagged(), open_polygons()})
    for (const char* mode : {"all", "corners-plus1"}) {
      const Tables on(mesh);
      expect_done(on.bake({"-l", "2", "--face-varying", mode, "--tags", "--precision", "double"}));
      expect_done(on.apply(on.mesh, on.path("applied.obj")));
      expect_done(sublimit(
          {"refine", on.mesh, "-s", "catmull-clark", "-l", "2", "--face-varying", mode, "-o", on.path("refined.obj")}));
      const Mesh made = read_mesh(on.path("applied.obj")), right = read_mesh(on.path("refined.obj"));
      ASSERT_EQ(made.face_varying.size(), 1u);
      EXPECT_EQ(difference(made, right, tolerance(mesh)), "");
      EXPECT_EQ(made.boundary, right.boundary);
      EXPECT_EQ(made.creasing, right.creasing);
      EXPECT_EQ(made.face_varying_interpolation, right.face_varying_interpolation);
      // Once more, by the tags alone.
      for (const char* name : {"applied", "refined"})
        expect_done(sublimit({"refine", on.path(std::string(name) + ".obj"), "-s", "catmull-clark", "-l", "1", "-o",
                              on.path(std::string(name) + "3.obj")}));
      EXPECT_EQ(difference(read_mesh(on.path("applied3.obj")), read_mesh(on.path("refined3.obj")), tolerance(mesh)),
                "");
    }
}

TEST(CliBakeChannels, OfTrianglesAndOfDualSchemes) {
  const Mesh mesh = with_channel(jittered(icosahedron()), {{0, 1}});
  for (const char* scheme : {"loop", "doo-sabin"}) {
    const Tables on(scheme == std::string("loop") ? mesh : with_channel(jittered(prism(5)), {}));
    expect_done(on.bake({"-l", "2", "--face-varying", "none", "--tags", "--precision", "double"}, scheme));
    expect_done(on.apply(on.mesh, on.path("applied.obj")));
    expect_done(
        sublimit({"refine", on.mesh, "-s", scheme, "-l", "2", "--face-varying", "none", "-o", on.path("refined.obj")}));
    EXPECT_EQ(difference(read_mesh(on.path("applied.obj")), read_mesh(on.path("refined.obj")), tolerance(mesh)), "");
  }
}

TEST(CliBakeChannels, ComeOnlyWhenAsked) {
  const Tables on(tagged());
  const auto applied = [&](const char* name) {
    expect_done(on.apply(on.mesh, on.path(name)));
    return read_file(on.path(name));
  };
  expect_done(on.bake({"-l", "1"}));
  const std::string plain = applied("plain.obj");
  EXPECT_EQ(plain.find("\nvt "), std::string::npos);
  EXPECT_EQ(plain.find("\nt "), std::string::npos);
  expect_done(on.bake({"-l", "1", "--tags"}));
  const std::string tags = applied("tags.obj");
  EXPECT_EQ(tags.find("\nvt "), std::string::npos);
  EXPECT_NE(tags.find("\nt crease "), std::string::npos);
  EXPECT_NE(tags.find("\nt corner "), std::string::npos);
  expect_done(on.bake({"-l", "1", "--face-varying", "all"}));
  const std::string values = applied("values.obj");
  EXPECT_NE(values.find("\nvt "), std::string::npos);
  EXPECT_EQ(values.find("\nt "), std::string::npos);
  // What has no place for them gets the rest.
  expect_done(on.bake({"-l", "1", "--face-varying", "all", "--tags"}));
  const Outcome rest = on.apply(on.mesh, on.path("out.ply"));
  EXPECT_EQ(rest.status, 0);
  EXPECT_NE(rest.err.find("a PLY file has no place for creases and corners"), std::string::npos) << rest.err;
  EXPECT_EQ(read_mesh(on.path("out.ply")).num_faces(), 24);
  expect_done(sublimit({"verify", on.table}));
}

TEST(CliBakeChannels, ArePlannedAndRefused) {
  const Tables on(tagged());
  expect_failure(on.bake({"--grid", "3", "--tags"}), 2, {"--tags", "-l LEVELS"});
  expect_failure(on.bake({"--grid", "3", "--face-varying", "all"}), 2, {"--face-varying", "-l LEVELS"});
  expect_failure(on.bake({"-l", "2", "--face-varying", "some"}), 2, {"--face-varying", "corners-only"});
  expect_failure(on.bake({"-l", "1", "--face-varying", "all", "--no-creases"}, "doo-sabin"), 2,
                 {"face-varying", "doo-sabin", "none"});
  EXPECT_FALSE(std::filesystem::exists(on.table));
  const Outcome plan =
      sublimit({"bake", on.mesh, "-s", "catmull-clark", "-l", "4", "--face-varying", "all", "--tags", "--plan"});
  expect_parts(expect_done(plan).out, {"about", "of table"});
}

/// A table without them is no table with them, and is made anew.
TEST(CliBakeChannels, AreJobsOfAManifest) {
  const Tables on(tagged());
  const auto run = [&](const std::string& more) {
    on.directory.write("jobs.jsonl",
                       "{\"mesh\": \"mesh.obj\", \"scheme\": \"catmull-clark\", \"levels\": 1, "
                       "\"output\": \"table.safetensors\"" +
                           more + "}\n");
    std::filesystem::remove(on.path("log.jsonl"));
    expect_done(sublimit({"bake", "--manifest", on.path("jobs.jsonl"), "--log", on.path("log.jsonl")}));
    return read_file(on.path("log.jsonl")).find("skipped") != std::string::npos;
  };
  const std::string both = ", \"face-varying\": \"boundaries\", \"tags\": true";
  EXPECT_FALSE(run(""));
  EXPECT_TRUE(run(""));
  EXPECT_FALSE(run(both));
  EXPECT_TRUE(run(both));
  EXPECT_FALSE(run(", \"face-varying\": \"boundaries\""));
  EXPECT_FALSE(run(", \"face-varying\": \"all\""));
  on.directory.write("jobs.jsonl", "{\"face-varying\": \"some\"}\n");
  expect_failure(sublimit({"bake", "--manifest", on.path("jobs.jsonl")}), 3, {"face-varying", "corners-only"});
}

}  // namespace
}  // namespace sublimit::testing

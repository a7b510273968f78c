// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi refine`: the points of shards without any, and the faces of one process.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"

namespace sublimit::testing {
namespace {

struct Case {
  const char* name;
  const char* scheme;
  Mesh mesh;
  TableRows rows = TableRows::level;
  int level = 2;
  BakeMethod method = BakeMethod::patterns;
};

std::vector<Case> cases() {
  Mesh creased = jittered(torus(7, 5));
  add_crease(creased, {0, 5, 10}, {10, 2.5f});
  Mesh open = jittered(grid(7, 6));
  open.holes = {5};
  Mesh none = open;
  none.boundary = Boundary::none;
  Mesh mixed = disjoint_union(jittered(prism(5)), jittered(polygon_ring({4, 5, 4, 6})));
  mixed.positions.conservativeResize(mixed.positions.rows() + 2, 3);  // vertices of no face
  mixed.positions.bottomRows(2).setConstant(0.1);
  // A strip: neighbourhoods that half a turn takes to themselves, and faces that begin at any corner.
  Mesh strip = jittered(grid(25, 1));
  for (Index f = 0; f < strip.num_faces(); ++f)
    std::rotate(strip.face_vertices.begin() + 4 * f, strip.face_vertices.begin() + 4 * f + f % 4,
                strip.face_vertices.begin() + 4 * f + 4);
  // Of the second, faces around come to a point twice, which no face of the first does.
  const Mesh wrapped = disjoint_union(jittered(torus(8, 6)), jittered(torus(3, 5)));
  return {{"creased", "catmull-clark", creased},
          {"wrapped", "catmull-clark", wrapped},
          {"creased limit", "catmull-clark", creased, TableRows::limit, 1},
          {"open", "catmull-clark", open},
          {"no boundary", "catmull-clark", none},
          {"strip", "catmull-clark", strip},
          {"cube", "catmull-clark", cube(), TableRows::limit, 0},
          {"mixed", "catmull-clark", mixed, TableRows::level, 3, BakeMethod::rows_then_patterns},
          {"mixed limit", "catmull-clark", mixed, TableRows::limit, 1, BakeMethod::rows_then_patterns},
          {"triangles", "loop", jittered(triangle_torus(7, 6))},
          {"icosahedron", "loop", jittered(icosahedron()), TableRows::limit, 2},
          {"butterfly", "butterfly", jittered(triangle_grid(5, 4))}};
}

/// Corners of all faces, one after the other.
std::vector<std::array<double, 3>> corners(const FaceList& faces, std::span<const double> points) {
  std::vector<std::array<double, 3>> corners;
  for (const Index p : faces.corners)
    corners.push_back({points[3 * size_t(p)], points[3 * size_t(p) + 1], points[3 * size_t(p) + 2]});
  return corners;
}

std::vector<std::array<double, 3>> corners_of_one_process(const Case& c) {
  const Scheme<double> scheme = find_scheme(c.scheme).value();
  Patterns patterns(scheme);
  const Baked baked =
      bake_by_patterns(patterns, control_level(scheme, c.mesh), {.rows = c.rows, .level = c.level},
                       {.first_by_rows = c.method == BakeMethod::rows_then_patterns, .owners = OwnerRule::first})
          .value();
  std::vector<double> points(size_t(3 * baked.table.table.num_points()));
  PatternEvaluator<double>(baked.table.table)
      .apply({c.mesh.positions.data(), size_t(c.mesh.positions.size())}, 3, points);
  return corners(faces_of(baked.table), points);
}

std::string words(const Case& c) {
  return std::string(" -s ") + c.scheme + " -l " + std::to_string(c.level) +
         (c.rows == TableRows::limit ? " --limit" : "");
}

TEST(Refine, HasThePointsOfShardsAndTheFacesOfOneProcess) {
  for (const Case& c : cases()) {
    const TemporaryDirectory directory;
    const auto path = [&](const char* name) { return (directory / name).string(); };
    write_obj(path("m.obj"), c.mesh);
    ASSERT_EQ(run_ranks(2, "bake " + path("m.obj") + words(c) + " -o " + path("shards")).status, 0) << c.name;
    ASSERT_EQ(run_ranks(1, "apply " + path("shards") + " " + path("m.obj") + " -o " + path("s.npy")).status, 0);
    const std::vector<std::array<double, 3>> expected = corners_of_one_process(c);
    std::string one;
    for (const int ranks : {1, 2, 3, 4}) {
      const std::string parts = ranks == 2 ? " --parts 5" : "";
      const RanksRun run = run_ranks(ranks, "refine " + path("m.obj") + words(c) + parts + " -o " + path("o.ply"));
      ASSERT_EQ(run.status, 0) << c.name << ": " << run.err;
      const std::string bytes = read_file(path("o.ply"));
      if (one.empty()) one = bytes;
      EXPECT_EQ(bytes == one, true) << c.name << " by " << ranks;
      const Mesh mesh = read_mesh(path("o.ply"));
      EXPECT_EQ(corners({mesh.face_sizes, mesh.face_vertices},
                        {mesh.positions.data(), size_t(mesh.positions.size())}) == expected,
                true)
          << c.name << " by " << ranks;
    }
    ASSERT_EQ(run_ranks(3, "refine " + path("m.obj") + words(c) + " -o " + path("o.npy")).status, 0);
    const std::string points = read_file(path("o.npy"));
    EXPECT_EQ(points == read_file(path("s.npy")), true) << c.name;
    EXPECT_NE(one.find(points.substr(128)), std::string::npos) << c.name;  // behind the header of an .npy
  }
}

TEST(Refine, NamesWhatItCannotWrite) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string();
  write_obj(obj, cube());
  for (const auto& [levels, name, error] :
       {std::tuple("2", "o.obj", ": unknown kind of output '.obj'; .npy and .ply can be written\n"),
        std::tuple("0", "o.ply", "level 0 of a table; 1 to 11 are right\n")}) {
    const RanksRun run =
        run_ranks(2, "refine " + obj + " -s catmull-clark -l " + levels + " -o " + (directory / name).string());
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.error().find(error), std::string::npos) << run.error();
    EXPECT_FALSE(std::filesystem::exists(directory / name));
  }
  write_obj(obj, torus(27, 19));
  const RanksRun run = run_ranks(2, "refine " + obj + " -s catmull-clark -l 11 -o " + (directory / "o.ply").string());
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.error().find("o.ply: 2151677952 points, and the faces of a .ply count them by 32 bits"),
            std::string::npos)
      << run.error();
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// `sublimit bake --tessellation`: a table that moves the points of a tessellation, and has its triangles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "stencils/cli_tables.h"
#include "sublimit/stencils/files/place_files.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/surface/limit_map.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Of a mesh, with the table that the tessellation makes.
struct Tessellated : Tables {
  Tessellated(const Mesh& control, const std::string& scheme, const std::vector<std::string>& more = {},
              const std::vector<std::string>& of_table = {})
      : Tables(control) {
    std::vector<std::string> all{"tessellate", mesh, "-s", scheme, "--chord", "1%", "-o", triangles, "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    expect_done(sublimit(all));
    std::vector<std::string> arguments{"--tessellation", triangles, "--precision", "double"};
    arguments.insert(arguments.end(), of_table.begin(), of_table.end());
    expect_done(bake(arguments, scheme));
  }
  const std::string triangles = path("triangles.ply"), out = path("out.ply");
};

/// The same mesh in another pose.
Mesh moved(Mesh mesh) {
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    mesh.positions.row(v) += 0.1 * Eigen::RowVector3d(std::sin(3 * v), std::cos(5 * v), std::sin(7 * v));
  return mesh;
}

TEST(CliTessellationTables, MovePointsAndKeepTriangles) {
  Mesh holed = jittered(grid(4, 3));
  holed.holes = {5};
  const std::vector<std::pair<std::string, Mesh>> jobs{{"catmull-clark", creased_cube()},
                                                       {"catmull-clark", jittered(prism(5))},
                                                       {"catmull-clark", holed},
                                                       {"loop", jittered(icosahedron())},
                                                       {"doo-sabin", jittered(prism(5))}};
  for (const auto& [scheme, mesh] : jobs) {
    SCOPED_TRACE(scheme);
    const Tessellated on(mesh, scheme);
    expect_done(on.apply(on.mesh, on.out));
    const Mesh first = read_mesh(on.triangles), again = read_mesh(on.out);
    ASSERT_GT(first.num_faces(), 10);
    EXPECT_EQ(again.face_sizes, first.face_sizes);
    EXPECT_EQ(again.face_vertices, first.face_vertices);
    ASSERT_EQ(again.num_vertices(), first.num_vertices());
    EXPECT_LE((again.positions - first.positions).cwiseAbs().maxCoeff(), other_route);

    const Mesh pose = moved(mesh);
    write_obj(on.path("pose.obj"), pose);
    expect_done(on.apply(on.path("pose.obj"), on.out));
    const Mesh there = read_mesh(on.out);
    EXPECT_EQ(there.face_vertices, first.face_vertices);
    const LimitMap surface(find_scheme(scheme).value(), pose);
    const Points limit = surface.evaluate(pose.positions, read_placed_faces(on.triangles).places).position;
    EXPECT_LE((there.positions - limit).cwiseAbs().maxCoeff(), other_route);
    EXPECT_GT((there.positions - first.positions).cwiseAbs().maxCoeff(), 0.01);
  }
}

const std::vector<std::string> normal_names{"nx", "ny", "nz"};

// Vertices on creases stand there once for each side, with the normal and the place of that side.
TEST(CliTessellationTables, HaveNormalsOfEachSide) {
  Mesh mesh = jittered(cube());
  add_crease(mesh, {0, 1, 3, 2, 0}, 10);
  const Tessellated on(mesh, "catmull-clark", {"--normals"}, {"--derivatives", "1"});
  expect_done(on.apply(on.mesh, on.out));
  const Mesh file = read_ply(on.triangles, normal_names), applied = read_ply(on.out, normal_names);
  ASSERT_EQ(file.vertex_values.size(), 3u);
  ASSERT_EQ(applied.vertex_values.size(), 3u);
  EXPECT_LE((applied.positions - file.positions).cwiseAbs().maxCoeff(), other_route);
  for (size_t k = 0; k < 3; ++k)
    for (size_t i = 0; i < file.vertex_values[k].values.size(); ++i)
      EXPECT_NEAR(applied.vertex_values[k].values[i], file.vertex_values[k].values[i], reference_angle) << i;

  // The same points without normals are fewer, as many as there are different ones.
  expect_done(sublimit({"tessellate", on.mesh, "-s", "catmull-clark", "--chord", "1%", "-o", on.out, "--quiet"}));
  std::map<std::array<double, 3>, int> copies;
  const auto key = [](const Points& p, Index i) { return std::array{p(i, 0), p(i, 1), p(i, 2)}; };
  const Points& points = file.positions;
  for (Index i = 0; i < points.rows(); ++i) ++copies[key(points, i)];
  EXPECT_EQ(std::ssize(copies), read_mesh(on.out).num_vertices());
  EXPECT_TRUE(std::ranges::all_of(copies, [](const auto& c) { return c.second <= 2; }));
  EXPECT_GT(std::ranges::count_if(copies, [](const auto& c) { return c.second == 2; }), 8);
  // Each is the normal of the triangles around: of a side, but for how the surface bends in a triangle.
  for (size_t c = 0; c < file.face_vertices.size(); c += 3) {
    const auto at = [&](size_t k) { return Eigen::Vector3d(points.row(file.face_vertices[c + k])); };
    const Eigen::Vector3d flat = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (size_t k = 0; k < 3; ++k) {
      const auto v = size_t(file.face_vertices[c + k]);
      Eigen::Vector3d normal;
      for (size_t i = 0; i < 3; ++i) normal[Eigen::Index(i)] = file.vertex_values[i].values[v];
      EXPECT_GT(normal.dot(flat), std::cos(0.5)) << c;
    }
  }
}

TEST(CliTessellationTables, ComeOfManifestsToo) {
  const Tessellated on(creased_cube(), "catmull-clark");
  const std::string table = read_file(on.table), log = on.path("log.jsonl"), jobs = on.path("jobs.jsonl");
  on.directory.write("jobs.jsonl", R"({"mesh": "mesh.obj", "scheme": "catmull-clark", "output": "made.safetensors",)"
                                   R"( "precision": "double", "tessellation": "triangles.ply"})");
  expect_parts(expect_done(sublimit({"bake", "--manifest", jobs})).out, {"1 done"});
  EXPECT_EQ(read_file(on.path("made.safetensors")), table);
  expect_parts(expect_done(sublimit({"bake", "--manifest", jobs})).out, {"1 skipped"});
  // The same places with other triangles are another table.
  Mesh one = read_mesh(on.triangles);
  Mesh turned = one;
  std::rotate(turned.face_vertices.begin(), turned.face_vertices.begin() + 1, turned.face_vertices.begin() + 3);
  add_places(turned, read_placed_faces(on.triangles).places);
  write_ply(on.triangles, turned);
  expect_parts(expect_done(sublimit({"bake", "--manifest", jobs})).out, {"1 done"});
}

TEST(CliTessellationTables, AreRefusedInClearWords) {
  const Tessellated on(creased_cube(), "catmull-clark");
  const auto refused = [&](const std::vector<std::string>& arguments, int status,
                           std::initializer_list<std::string_view> parts) {
    std::filesystem::remove(on.table);
    expect_failure(on.bake(arguments), status, parts);
    EXPECT_FALSE(std::filesystem::exists(on.table));
  };
  refused({"--tessellation", on.mesh}, 3, {"mesh.obj", ".ply", "tessellate"});
  refused({"--tessellation", on.path("none.ply")}, 3, {"none.ply"});
  refused({"--tessellation", on.triangles, "-l", "2"}, 2, {"more than one", "--tessellation"});
  refused({"--tessellation", on.triangles, "--tags"}, 2, {"--tags"});
  Mesh plain = read_mesh(on.triangles);
  plain.vertex_values.clear();  // the places
  write_ply(on.path("plain.ply"), plain);
  refused({"--tessellation", on.path("plain.ply")}, 3, {"plain.ply", "place_face", "sublimit tessellate"});
  std::vector<Place> places = read_placed_faces(on.triangles).places;
  const auto refused_places = [&](std::initializer_list<std::string_view> parts) {
    Mesh mesh = plain;
    add_places(mesh, places);
    write_ply(on.path("off.ply"), mesh);
    refused({"--tessellation", on.path("off.ply")}, 3, parts);
  };
  places[7].face = 6;
  refused_places({"off.ply", "vertex 7", "face 6 does not exist", "0 to 5"});
  places[7] = {5, 0.5, 1.5};
  refused_places({"off.ply", "vertex 7", "(0.5, 1.5)"});
  places[7] = {5, std::nan(""), 0};
  refused_places({"off.ply", "place_u", "finite"});
  const std::string far = on.directory.write(
      "far.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uint place_face\nproperty float place_u\nproperty float place_v\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 0\n1 0 0 4294967295 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
  refused({"--tessellation", far}, 3, {"far.ply", "vertex 1", "4294967295"});
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// `sublimit tessellate`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "support/skip.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string write_plain_cube(const TemporaryDirectory& directory) {
  write_obj(directory / "cube.obj", cube());
  return (directory / "cube.obj").string();
}

/// A cube whose faces each have the whole of [0, 1]^2: every edge is a seam.
std::string write_textured_cube(const TemporaryDirectory& directory) {
  Mesh mesh = cube();
  Mesh::FaceVarying uv{"uv", (Points(4, 2) << 0, 0, 1, 0, 1, 1, 0, 1).finished(), {}};
  for (int f = 0; f < 6; ++f) uv.indices.insert(uv.indices.end(), {0, 1, 2, 3});
  mesh.face_varying.push_back(uv);
  write_obj(directory / "textured.obj", mesh);
  return (directory / "textured.obj").string();
}

TEST(CliTessellate, WritesTrianglesNormalsAndPlaces) {
  const TemporaryDirectory directory;
  Mesh creased = cube();
  add_crease(creased, {0, 1, 3, 2, 0}, 10);
  write_obj(directory / "cube.obj", creased);
  const std::string mesh = (directory / "cube.obj").string(), obj = (directory / "o.obj").string(),
                    ply = (directory / "o.ply").string(), places = (directory / "places.csv").string(),
                    samples = (directory / "samples.csv").string();
  const Outcome done = expect_done(sublimit(
      {"tessellate", mesh, "-s", "catmull-clark", "--chord", "1%", "--normals", "--places", places, "-o", obj}));
  expect_parts(done.out, {"triangles", "from the limit"});
  expect_done(sublimit({"tessellate", mesh, "-s", "catmull-clark", "--chord", "1%", "-o", ply, "--quiet"}));
  const Mesh triangles = read_mesh(obj);
  EXPECT_EQ(triangles.positions, read_mesh(ply).positions);
  EXPECT_TRUE(std::ranges::all_of(triangles.face_sizes, [](Index n) { return n == 3; }));
  expect_parts(read_file(obj), {"\nvn ", "//"});
  // The places are those of the points.
  expect_done(sublimit({"sample", mesh, "-s", "catmull-clark", "--at", places, "-o", samples, "--quiet"}));
  const std::vector<CsvRow> rows = csv_rows(samples);
  ASSERT_EQ(std::ssize(rows), triangles.positions.rows() + 1);
  for (Eigen::Index i = 0; i < triangles.positions.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      EXPECT_NEAR(csv_number(rows[size_t(i) + 1][size_t(4 + k)]), triangles.positions(i, k), other_route);
}

TEST(CliTessellate, RefusesInClearWords) {
  const TemporaryDirectory directory;
  const std::string mesh = write_plain_cube(directory), out = (directory / "o.obj").string();
  const auto refused = [&](std::vector<std::string> more, int status, std::initializer_list<std::string_view> parts) {
    std::vector<std::string> all{"tessellate", mesh, "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    expect_failure(sublimit(all), status, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused({"-s", "catmull-clark", "--chord", "0"}, 2, {"--chord 0", "above 0"});
  refused({"-s", "catmull-clark", "--chord", "-1%"}, 2, {"--chord -1%"});
  refused({"-s", "catmull-clark", "--chord", "thin"}, 2, {"--chord thin"});
  refused({"-s", "catmull-clark", "--chord", "1", "--angle", "0"}, 2, {"--angle 0"});
  refused({"-s", "catmull-clark", "--chord", "1", "--max-triangles", "0"}, 2, {"--max-triangles 0"});
  refused({"-s", "catmull-clark", "--chord", "1e-7", "--max-triangles", "1000"}, 4, {"more than"});
  refused({"-s", "kobbelt", "--chord", "0.1"}, 3, {"kobbelt", "polynomial"});
}

TEST(CliTessellate, TellsAspectRatios) {
  const TemporaryDirectory directory;
  // Two right triangles a square: 2 each.
  const Outcome done = expect_done(sublimit({"tessellate", write_plain_cube(directory), "-s", "bilinear", "--chord",
                                             "1", "-o", (directory / "o.ply").string()}));
  expect_parts(done.out, {"longest side over shortest height", "median 2, largest 2"});
}

TEST(CliTessellate, TellsFacesOfTriangles) {
  const TemporaryDirectory directory;
  const std::string mesh = write_plain_cube(directory);
  for (const char* name : {"o.ply", "o.obj"}) {
    const std::string out = (directory / name).string();
    expect_done(sublimit({"tessellate", mesh, "-s", "bilinear", "--chord", "1", "--face-ids", "-o", out, "--quiet"}));
    EXPECT_EQ(read_mesh(out).face_sizes.size(), 12u);
  }
  expect_parts(read_file(directory / "o.ply"), {"property int face_id\n"});
  const std::string obj = read_file(directory / "o.obj");
  for (int f = 0; f < 6; ++f) expect_parts(obj, {"g face_" + std::to_string(f) + "\nf "});
}

TEST(CliTessellate, CarriesTextureCoordinates) {
  const TemporaryDirectory directory;
  const std::string mesh = write_textured_cube(directory), obj = (directory / "o.obj").string(),
                    ply = (directory / "o.ply").string(), places = (directory / "places.csv").string();
  for (const std::string& out : {obj, ply})
    expect_done(sublimit(
        {"tessellate", mesh, "-s", "catmull-clark", "--chord", "1%", "--places", places, "-o", out, "--quiet"}));
  const Mesh triangles = read_mesh(obj);
  ASSERT_EQ(triangles.face_varying.size(), 1u);
  const Mesh::FaceVarying& uv = triangles.face_varying[0];
  // Linear on each face: u and v of the place themselves. Each face has its own values, each of them once.
  std::map<std::pair<Index, Index>, int> pairs;
  for (size_t c = 0; c < uv.indices.size(); ++c) ++pairs[{triangles.face_vertices[c], uv.indices[c]}];
  EXPECT_EQ(std::ssize(pairs), uv.values.rows());
  EXPECT_GT(uv.values.rows(), triangles.positions.rows());
  EXPECT_EQ(uv.values.minCoeff(), 0);
  EXPECT_EQ(uv.values.maxCoeff(), 1);
  // The PLY has a vertex for each value, and a place for each vertex.
  const Mesh split = read_mesh(ply);
  EXPECT_EQ(split.positions.rows(), uv.values.rows());
  EXPECT_EQ(std::ssize(csv_rows(places)), split.positions.rows() + 1);
  expect_parts(read_file(ply), {"property double s\nproperty double t\n"});
  std::set<std::array<double, 3>> points;
  for (Index i = 0; i < split.positions.rows(); ++i)
    points.insert({split.positions(i, 0), split.positions(i, 1), split.positions(i, 2)});
  EXPECT_EQ(std::ssize(points), triangles.positions.rows());  // the same bits on both sides of a seam
}

TEST(CliTessellate, HasNoFileForWhatCannotBeWritten) {
  const TemporaryDirectory directory;
  const std::string mesh = write_plain_cube(directory);
  const auto refused = [&](const std::string& name, const std::vector<std::string>& more,
                           std::initializer_list<std::string_view> parts) {
    const std::string out = (directory / name).string();
    std::vector<std::string> all{"tessellate", mesh, "-s", "catmull-clark", "--chord", "1", "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    expect_failure(sublimit(all), 2, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused("o.dae", {}, {".obj", ".ply", ".off", ".stl", ".glb", ".vtu"});
  refused("o.glb", {"--face-ids"}, {"--face-ids", ".vtu"});
  refused("o.vtu", {"--normals"}, {"--normals", "polynomials"});
  refused("o.vtu", {"--angle", "5"}, {"--angle"});
  refused("o.vtu", {"--places", (directory / "p.csv").string()}, {"--places"});
}

TEST(CliTessellate, TakesRatesOfEdges) {
  const TemporaryDirectory directory;
  const std::string mesh = write_plain_cube(directory), out = (directory / "o.obj").string(),
                    rates = directory.write("r.csv", "v0,v1,rate\n0,1,3\n3,1,2\n").string();
  const Outcome done = expect_done(sublimit({"tessellate", mesh, "-s", "kobbelt", "--rates", rates, "-o", out}));
  expect_parts(done.out, {"13 points by the rates of edges", "aspect ratios"});
  EXPECT_EQ(read_mesh(out).positions.rows(), 8 + 2 + 1 + 2);  // one face has 3 x 2 squares, two points inside
  const auto refused = [&](const std::string& text, std::initializer_list<std::string_view> parts) {
    const std::string path = directory.write("wrong.csv", text).string(), none = (directory / "none.obj").string();
    expect_failure(sublimit({"tessellate", mesh, "-s", "loop", "--triangulate", "--rates", path, "-o", none}), 3,
                   parts);
    EXPECT_FALSE(std::filesystem::exists(none));
  };
  refused("", {"wrong.csv"});
  refused("a,b\n", {"v0,v1,rate"});
  refused("v0,v1,rate\n0,7,2\n", {"wrong.csv:2", "0 to 7"});
  refused("v0,v1,rate\n0,1,0\n", {"wrong.csv:2", "1 to 4194304"});
  refused("v0,v1,rate\n0,1,2\n1,0,2\n", {"wrong.csv:3", "already"});
  expect_failure(sublimit({"tessellate", mesh, "-s", "loop", "-o", out}), 2, {"--chord", "--rates"});
  // With a chord they are the least: 4 and 2 segments, and 4 triangles along the first edge in each face.
  const Outcome both =
      expect_done(sublimit({"tessellate", mesh, "-s", "bilinear", "--chord", "1", "--rates", rates, "-o", out}));
  expect_parts(both.out, {"at most 0 from the limit"});
  EXPECT_GE(read_mesh(out).num_vertices(), 8 + 3 + 1);
  expect_failure(sublimit({"tessellate", mesh, "-s", "loop", "--angle", "5", "--rates", rates, "-o", out}), 2,
                 {"--angle", "--chord"});
}

// VTK evaluates the cells of the file inside; `sample` the limit at the same places.
TEST(CliTessellate, CellsAreTheLimitInVtk) {
  const std::string python = "/usr/bin/python3";
  SUBLIMIT_NEEDS_PROGRAM(std::system((python + " -c 'import vtkmodules.vtkIOXML' 2>/dev/null").c_str()) == 0,
                         "python3-vtk9");
  const TemporaryDirectory directory;
  Mesh creased = jittered(cube());
  add_crease(creased, {0, 1, 3}, 1.5);
  const std::vector<std::pair<std::string, Mesh>> jobs{{"catmull-clark", jittered(torus(7, 5))},
                                                       {"catmull-clark", jittered(prism(5))},
                                                       {"catmull-clark", creased},
                                                       {"loop", jittered(icosahedron())},
                                                       {"loop", jittered(triangle_torus(6, 5))},
                                                       {"doo-sabin", jittered(prism(5))},
                                                       {"mid-edge", jittered(torus(7, 5))}};
  for (size_t k = 0; k < jobs.size(); ++k) {
    const auto& [scheme, mesh] = jobs[k];
    SCOPED_TRACE(scheme + " " + std::to_string(k));
    const auto file = [&](const char* name) { return (directory / (std::to_string(k) + name)).string(); };
    write_obj(file(".obj"), mesh);
    const double chord = 1e-3;
    expect_parts(expect_done(sublimit({"tessellate", file(".obj"), "-s", scheme, "--chord", std::to_string(chord), "-o",
                                       file(".vtu")}))
                     .out,
                 {"exact Bezier cells", "bilinear"});
    ASSERT_EQ(std::system((python + " " SUBLIMIT_SOURCE "/tests/stencils/read_cells.py " + file(".vtu") + " " +
                           file("-places.csv") + " " + file("-points.csv"))
                              .c_str()),
              0);
    expect_done(sublimit(
        {"sample", file(".obj"), "-s", scheme, "--at", file("-places.csv"), "-o", file("-limit.csv"), "--quiet"}));
    const std::vector<CsvRow> limit = csv_rows(file("-limit.csv")), cells = csv_rows(file("-points.csv"));
    ASSERT_EQ(limit.size(), cells.size());
    ASSERT_GT(cells.size(), 100u);
    double exact = 0, near = 0;
    for (size_t i = 1; i < cells.size(); ++i)
      for (size_t c = 0; c < 3; ++c) {
        const double off = std::abs(csv_number(limit[i][4 + c]) - csv_number(cells[i][1 + c]));
        double& largest = csv_number(cells[i][0]) == 1 ? exact : near;
        largest = std::max(largest, off);
      }
    EXPECT_LE(exact, other_route * diagonal(mesh.positions));
    EXPECT_LE(near, chord);
  }
}

}  // namespace
}  // namespace sublimit::testing

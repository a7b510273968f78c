// SPDX-License-Identifier: Apache-2.0
// Subcommands that take the limit of a mesh, or classical surfaces: triangles, integrals, clouds.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/free_form.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::json;

/// A sphere and a torus of NURBS, apart from each other.
struct Shapes {
  TemporaryDirectory directory;
  Shapes() {
    RationalShape sphere = unit_sphere();
    sphere.columns.col(0) += 10 * sphere.columns.col(3);
    write_free_form(path("shapes.obj"), free_form_of({sphere, torus()}));
  }
  std::string path(std::string_view name) const { return (directory / name).string(); }
};

TEST(CliPatchSurfaces, TrianglesAreClosedAndSayWhereTheyAre) {
  const Shapes shapes;
  for (const char* const name : {"out.obj", "out.ply"}) {
    SCOPED_TRACE(name);
    const Outcome done = expect_done(sublimit({"tessellate", shapes.path("shapes.obj"), "--chord", "1%", "--face-ids",
                                               "--places", shapes.path("places.csv"), "-o", shapes.path(name)}));
    EXPECT_NE(done.out.find("from the patches"), std::string::npos) << done.out;
    const Mesh mesh = read_mesh(shapes.path(name));
    const Topology t(view(mesh));
    EXPECT_EQ(t.num_vertices() - t.num_edges() + t.num_faces(), 2);  // a sphere and a torus
    for (Index h = 0; h < t.num_half_edges(); ++h) EXPECT_TRUE(exists(t.twin(HalfEdge{h})));
    // Each point is the surface at its place.
    expect_done(sublimit({"sample", shapes.path("shapes.obj"), "--at", shapes.path("places.csv"), "-o",
                          shapes.path("points.csv"), "--quiet"}));
    std::istringstream lines(read_file(shapes.path("points.csv")));
    std::string line;
    std::getline(lines, line);
    for (Index v = 0; v < t.num_vertices(); ++v) {
      ASSERT_TRUE(std::getline(lines, line));
      std::istringstream row(line);
      std::vector<std::string> fields;
      for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
      const Eigen::RowVector3d x(std::stod(fields.at(4)), std::stod(fields.at(5)), std::stod(fields.at(6)));
      EXPECT_LE((x - mesh.positions.row(v)).norm(), 20 * float_reference);
    }
  }
  expect_parts(read_file(shapes.path("out.ply")), {"property int face_id"});
  expect_parts(read_file(shapes.path("out.obj")), {"g face_0", "g face_23"});  // 8 and 16 faces
  expect_done(sublimit({"tessellate", shapes.path("shapes.obj"), "--chord", "1%", "-o", shapes.path("out.glb")}));
}

TEST(CliPatchSurfaces, IntegralsAreThoseOfTheShapes) {
  const Shapes shapes;
  const Json info =
      Json::parse(expect_done(sublimit({"info", shapes.path("shapes.obj"), "--limit", "--json"})).out).at("limit");
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(info.at("area").get<double>(), 4 * pi + 12 * pi * pi, found_again);
  EXPECT_NEAR(info.at("solid").at("volume").get<double>(), 4 * pi / 3 + 6 * pi * pi, found_again);
  EXPECT_NE(expect_done(sublimit({"info", shapes.path("shapes.obj"), "--limit"})).out.find("  volume "),
            std::string::npos);
}

TEST(CliPatchSurfaces, CloudsMoveControlPointsAndKeepWeights) {
  const Shapes shapes;
  expect_done(sublimit({"tessellate", shapes.path("shapes.obj"), "--chord", "1%", "-o", shapes.path("cloud.ply")}));
  FreeForm moved = read_free_form(shapes.path("shapes.obj"));
  moved.vertices.col(2) *= 1.05;
  write_free_form(shapes.path("moved.obj"), moved);
  const Outcome done = expect_done(sublimit({"fit", shapes.path("moved.obj"), "--cloud", shapes.path("cloud.ply"), "-o",
                                             shapes.path("fitted.obj"), "--report", shapes.path("fit.json")}));
  const FreeForm fitted = read_free_form(shapes.path("fitted.obj"));
  EXPECT_EQ(fitted.weights, moved.weights);
  const Json iterations = Json::parse(read_file(shapes.path("fit.json"))).at("iterations");
  EXPECT_GT(iterations.front().at("rms").get<double>(), 0.01);
  EXPECT_LT(iterations.back().at("rms").get<double>(), 0.01 * iterations.front().at("rms").get<double>()) << done.out;
}

TEST(CliPatchSurfaces, SayWhatIsForMeshes) {
  const Shapes shapes;
  shapes.directory.write("rates.csv", "v0,v1,rate\n0,1,2\n");
  const std::string given = shapes.path("shapes.obj"), out = shapes.path("out.obj");
  const auto refused = [&](const std::vector<std::string>& arguments, int status, std::string_view what) {
    expect_failure(sublimit(arguments), status, {what});
    EXPECT_FALSE(std::filesystem::exists(arguments.back()));
  };
  refused({"tessellate", given, "--rates", shapes.path("rates.csv"), "-o", out}, 2, "--rates is for meshes");
  refused({"tessellate", given, "--chord", "1%", "-o", shapes.path("out.vtu")}, 2,
          all_formats().writers_in_words({contents::meshes}, "and") + " are right");
  refused({"tessellate", given, "--chord", "1%", "-s", "loop", "-o", out}, 3, "free-form");
}

}  // namespace
}  // namespace sublimit::testing

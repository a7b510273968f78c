// SPDX-License-Identifier: Apache-2.0
// `sublimit fit`: the limit of what it writes goes through the targets; what it cannot meet it refuses, and writes
// nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/drawn_panels.h"
#include "stencils/markup.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr double exact_position = 1e-12;  // of a bounding box of size 1
constexpr double exact_normal = 1e-10;    // radians
constexpr double reproduced = 1e-10;      // of a sphere of radius 1, by torus pieces
/// Places in tenths of a pixel, each rounded: half of one from the place, and as much in the camera found from others.
constexpr double rounded_place = 1;

/// A mesh and targets in a directory.
struct Job {
  TemporaryDirectory directory;
  std::string mesh = (directory / "cage.obj").string(), targets = (directory / "in.csv").string(),
              output = (directory / "out.obj").string();

  Job(const Mesh& control, const std::string& csv) {
    write_obj(mesh, control);
    directory.write("in.csv", csv);
  }
  std::string path(const char* name) const { return (directory / name).string(); }
  Outcome fit(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"fit", mesh, "--targets", targets, "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sublimit(arguments);
  }
  /// Vertices of the output on the limit, by the program.
  Points limit(const std::string& scheme) const {
    expect_done(sublimit({"limit", output, "-s", scheme, "-o", path("limit.obj"), "--quiet"}));
    return read_mesh(path("limit.obj")).positions;
  }
  void expect_refused(const std::vector<std::string>& more, int status,
                      std::initializer_list<std::string_view> parts) const {
    const Outcome outcome = fit(more);
    expect_failure(outcome, status, parts);
    EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
    EXPECT_EQ(directory.num_files(), 2);
  }
};

std::string row(Index vertex, const Eigen::RowVector3d& p) {
  std::string text = format_number(vertex);
  for (const double x : p) text += "," + format_number(x);
  return text;
}

std::string points_csv(const Points& points) {
  std::string text = "vertex,x,y,z\n";
  for (Index v = 0; v < points.rows(); ++v) text += row(v, points.row(v)) + "\n";
  return text;
}

/// Fields of all lines but the header.
std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  const std::string text = read_file(path);
  std::vector<std::vector<std::string>> rows;
  for (size_t at = text.find('\n') + 1; at < text.size(); ++at) {
    rows.push_back({""});
    for (; text[at] != '\n'; ++at) {
      if (text[at] == ',')
        rows.back().emplace_back();
      else
        rows.back().back() += text[at];
    }
  }
  return rows;
}

/// The cube's corners, off by a little, with normals that are not quite theirs.
const Points corners = jittered(cube(), .1, 3).positions;
const Points corner_normals = jittered(cube(), .3, 7).positions;
std::string normals_csv() {
  std::string text = "vertex,x,y,z,nx,ny,nz\n";
  for (Index v = 0; v < corners.rows(); ++v) {
    text += row(v, corners.row(v));
    for (const double n : corner_normals.row(v)) text += v == 5 ? "," : "," + format_number(n);
    text += "\n";
  }
  return text;
}

TEST(CliFit, LimitsOfTheOutputAreTheTargets) {
  const Job job(octahedron(), points_csv(jittered(octahedron()).positions));
  const Outcome outcome = expect_done(job.fit({"-s", "loop"}));
  expect_parts(outcome.out, {"6 control points", "meets 6 points", "rank 6", "position error"});
  EXPECT_EQ(outcome.out.find("refinement"), std::string::npos);
  EXPECT_LE((job.limit("loop") - jittered(octahedron()).positions).cwiseAbs().maxCoeff(), exact_position);
}

TEST(CliFit, RefinesWhereTheCubeIsSingularAndSaysSo) {
  const Job job(cube(), points_csv(corners));
  const Outcome outcome = expect_done(job.fit({"-s", "catmull-clark", "--report", job.path("out.json")}));
  expect_parts(outcome.out,
               {"26 control points", "1 refinement", "vertices 0, 1, 2, 3, 4, 5, 6, 7 depend on each other",
                "rank 7 of 8", "rank 8", "vertices 0 to 7", "in order"});
  EXPECT_LE((job.limit("catmull-clark").topRows(8) - corners).cwiseAbs().maxCoeff(), exact_position);
  const auto report = nlohmann::json::parse(read_file(job.path("out.json")));
  EXPECT_EQ(report["format"], "sublimit-fit");
  EXPECT_EQ(report["attempts"].size(), 2u);
  EXPECT_EQ(report["attempts"][0]["solved"], false);
  EXPECT_EQ(report["attempts"][0]["conditioning"]["rank"], 7);
  EXPECT_EQ(report["attempts"][0]["undetermined"].size(), 8u);
  EXPECT_EQ(report["attempts"][1]["solved"], true);
  EXPECT_EQ(report["output"]["refinements"], 1);
  EXPECT_EQ(report["output"]["keeps_vertices"], true);
  EXPECT_EQ(report["targets"]["position_error"].size(), 8u);
  EXPECT_EQ(report["targets"]["x"][3].get<double>(), corners(3, 0));
  EXPECT_LE(report["position_error"]["largest"].get<double>(), exact_position);
}

TEST(CliFit, MeetsNormalsAndLeavesOthersFree) {
  const Job job(cube(), normals_csv());
  for (const char* scheme : {"catmull-clark", "doo-sabin", "kobbelt"}) {
    SCOPED_TRACE(scheme);
    const Outcome outcome = expect_done(job.fit({"-s", scheme, "--report", job.path("fit.json")}));
    expect_parts(outcome.out, {"8 points and 7 normals", "38 conditions are too many for 24 coordinates", "rad"});
    const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
    EXPECT_LE(report["normal_error"]["largest"].get<double>(), exact_normal);
    EXPECT_EQ(report["normal_error"]["count"], 7);
    EXPECT_TRUE(report["targets"]["normal_error"][5].is_null());
    const bool keeps = std::string_view(scheme) != "doo-sabin";
    EXPECT_EQ(report["output"]["keeps_vertices"], keeps);
    EXPECT_EQ(outcome.out.find("does not keep vertices") == std::string::npos, keeps);
    if (keeps) {
      EXPECT_LE((job.limit(scheme).topRows(8) - corners).cwiseAbs().maxCoeff(), exact_position);
    }
  }
  expect_done(sublimit({"limit", job.output, "-s", "kobbelt", "--normals", "-o", job.path("n.obj"), "--quiet"}));
  // The first normals of the file belong to the first vertices.
  const Mesh limit = read_mesh(job.path("n.obj"));
  const std::string text = read_file(job.path("n.obj"));
  const size_t at = text.find("vn ");
  ASSERT_NE(at, std::string::npos);
  double n[3];
  ASSERT_EQ(std::sscanf(text.c_str() + at, "vn %lf %lf %lf", n, n + 1, n + 2), 3);
  EXPECT_LE((Eigen::RowVector3d(n[0], n[1], n[2]) - corner_normals.row(0).normalized()).norm(), exact_normal);
}

TEST(CliFit, KeepsTagsAndTextureCoordinates) {
  Mesh mesh = grid(3, 3);
  add_crease(mesh, {5, 6, 10}, 2.5f);
  mesh.face_varying = {{"st", mesh.positions.leftCols(2), mesh.face_vertices}};
  const Job job(mesh, points_csv(jittered(mesh).positions));
  expect_done(job.fit({"-s", "catmull-clark", "--refine", "1"}));
  const Mesh fitted = read_mesh(job.output);
  EXPECT_EQ(fitted.creases.size(), 4u);
  EXPECT_EQ(fitted.creases[0].sharpness, 1.5f);
  ASSERT_EQ(fitted.face_varying.size(), 1u);
  EXPECT_LE((job.limit("catmull-clark").topRows(16) - jittered(mesh).positions).cwiseAbs().maxCoeff(), exact_position);
}

/// Rows but one.
Points without(const Points& points, Index row) {
  Points rest(points.rows() - 1, points.cols());
  rest << points.topRows(row), points.bottomRows(points.rows() - 1 - row);
  return rest;
}

TEST(CliFit, DrawsTargetsAndTheirNormalsWhereTheyAreInThreePanels) {
  const Job job(cube(), normals_csv());
  expect_done(
      job.fit({"-s", "catmull-clark", "--picture", job.path("fit.svg"), "--report", job.path("fit.json"), "--quiet"}));
  const std::string svg = read_file(job.path("fit.svg"));
  EXPECT_EQ(read_markup(svg).fault, "");
  const std::vector<DrawnPanel> panels = read_panels(svg);
  ASSERT_EQ(panels.size(), 3u);
  const Index control_points =
      nlohmann::json::parse(read_file(job.path("fit.json")))["output"]["vertices"].get<Index>();
  const std::pair<std::string, std::string> words[] = {
      {"given", "8 points, 7 normals"},
      {"limit of the given mesh", "catmull-clark"},
      {"limit of the fit", std::to_string(control_points) + " control points"}};
  for (size_t p = 0; p < 3; ++p) EXPECT_EQ(std::pair(panels[p].caption, panels[p].note), words[p]);

  // The limit of the given mesh lies inside and hides the target that is farthest from the eye, no other: the rest are
  // dots in their order, and tell the camera, with more equations than unknowns.
  constexpr int rim = 66, disc = 46, needle = 19;  // tenths of a pixel
  const Index hidden = 0;                          // the eye sees +x, +y, +z
  const std::vector<Eigen::Vector2d> seen = panels[1].dots(disc);
  ASSERT_EQ(seen.size(), 7u);
  const FoundCamera camera(without(corners, hidden), seen);
  EXPECT_LE(camera.error(), rounded_place);
  for (const DrawnPanel& panel : panels) {
    SCOPED_TRACE(panel.caption);
    EXPECT_GT(panel.fills, 0);
    EXPECT_EQ(panel.dots(rim), panel.dots(disc));
    std::vector<Index> marked;
    for (const Eigen::Vector2d& dot : panel.dots(disc))
      for (Index v = 0; v < 8; ++v)
        if ((camera(corners.row(v)) - dot).cwiseAbs().maxCoeff() <= rounded_place) marked.push_back(v);
    EXPECT_EQ(marked.size(), panel.dots(disc).size()) << "a dot is at no target";
    EXPECT_TRUE(std::adjacent_find(marked.begin(), marked.end(), std::greater_equal<>()) == marked.end());
    EXPECT_GE(marked.size(), 3u);  // what the surface does not hide

    // Every needle lies between a target and the end of its normal, and whoever is seen has one, if it has a normal.
    std::set<Index> pricked;
    for (const auto& piece : panel.stroke(needle).pieces) {
      Index owner = -1;
      for (Index v = 0; v < 8; ++v) {
        const Eigen::Vector2d a = camera(corners.row(v)),
                              d = camera(corners.row(v) +
                                         .08 * diagonal(corners) * corner_normals.row(v).normalized()) -
                                  a;
        const auto on_it = [&](const Eigen::Vector2d& p) {
          const double along = (p - a).dot(d) / d.squaredNorm(), slack = rounded_place * std::sqrt(2) / d.norm();
          return (p - a - along * d).norm() <= rounded_place * std::sqrt(2) && along >= -slack && along <= 1 + slack;
        };
        if (on_it(piece.front()) && on_it(piece.back())) owner = v;
      }
      EXPECT_GE(owner, 0) << "a line of nobody";
      pricked.insert(owner);
    }
    EXPECT_FALSE(pricked.contains(5)) << "vertex 5 has no normal";
    for (const Index v : marked) EXPECT_EQ(pricked.contains(v), v != 5) << v;
  }
}

TEST(CliFit, FindsTheControlPointsOfSampledPlaces) {
  const Mesh mesh = jittered(octahedron(), .2, 5);
  const Job job(mesh, "");
  expect_done(sublimit({"sample", job.mesh, "-s", "loop", "--grid", "4", "-o", job.path("s.csv"), "--quiet"}));
  std::string csv = "face,u,v,x,y,z\n";  // columns face,u,v,status,x,y,z,nx,ny,nz
  for (const std::vector<std::string>& fields : rows_of(job.path("s.csv")))
    csv += fields[0] + "," + fields[1] + "," + fields[2] + "," + fields[4] + "," + fields[5] + "," + fields[6] + "\n";
  Mesh guess = octahedron();
  guess.positions.row(3) = mesh.positions.row(3);
  write_obj(job.mesh, guess);
  job.directory.write("in.csv", csv);
  const Outcome outcome = expect_done(job.fit({"-s", "loop", "--report", job.path("fit.json")}));
  expect_parts(outcome.out, {"6 control points", "is near 80 points", "80 conditions on 6 control points: rank 6"});
  EXPECT_LE((read_mesh(job.output).positions - mesh.positions).cwiseAbs().maxCoeff(), exact_position);
  const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
  EXPECT_EQ(report["kind"], "least-squares");
  EXPECT_EQ(report["targets"]["u"].size(), 80u);
  // Pinned points stay where the mesh has them, or where the file does.
  expect_done(job.fit({"-s", "loop", "--pin", "3,0", "--quiet"}));
  EXPECT_EQ(read_mesh(job.output).positions.row(0), guess.positions.row(0));
  job.directory.write("pins.csv", "vertex,x,y,z\n4,7,8,9\n");
  expect_done(job.fit({"-s", "loop", "--pin", job.path("pins.csv"), "--thin-plate", ".1", "--quiet"}));
  EXPECT_EQ(read_mesh(job.output).positions.row(4), Eigen::RowVector3d(7, 8, 9));
}

TEST(CliFit, FindsTheSurfaceOfACloud) {
  const Mesh mesh = jittered(octahedron(), .1, 5);
  const Job job(mesh, "");
  expect_done(sublimit({"sample", job.mesh, "-s", "loop", "--random", "300", "-o", job.path("s.csv"), "--quiet"}));
  std::string csv = "x,y,z\n";  // columns face,u,v,status,x,y,z,nx,ny,nz
  for (const std::vector<std::string>& fields : rows_of(job.path("s.csv")))
    csv += fields[4] + "," + fields[5] + "," + fields[6] + "\n";
  job.directory.write("cloud.csv", csv);
  write_obj(job.mesh, octahedron());
  const Outcome outcome = expect_done(sublimit({"fit", job.mesh, "--cloud", job.path("cloud.csv"), "-s", "loop", "-o",
                                                job.output, "--report", job.path("fit.json")}));
  expect_parts(outcome.out, {"is near 300 points", "iterations: from "});
  const double size = diagonal(mesh.positions);
  EXPECT_LE((read_mesh(job.output).positions - mesh.positions).rowwise().norm().maxCoeff(),
            found_control_points * size);
  const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
  EXPECT_EQ(report["kind"], "cloud");
  EXPECT_GT(report["iterations"][0]["rms"].get<double>(), 1e-2);
  EXPECT_LE(report["position_error"]["largest"].get<double>(), found_again * size);
}

TEST(CliFit, RefusesOtherClouds) {
  const Job job(cube(), "x,y,z\n0,0,0\n");
  const auto refused = [&](std::vector<std::string> more, int status, std::initializer_list<std::string_view> parts) {
    more.insert(more.begin(), {"fit", job.mesh, "-s", "catmull-clark", "-o", job.output});
    expect_failure(sublimit(more), status, parts);
    EXPECT_EQ(job.directory.num_files(), 2);
  };
  refused({}, 2, {"--targets IN.csv", "--cloud POINTS"});
  refused({"--cloud", job.targets, "--targets", job.targets}, 2, {"both --targets and --cloud"});
  refused({"--cloud", job.targets, "--samples", "9"}, 2, {"--samples", "no faces"});
  refused({"--cloud", job.mesh, "--seed", "9"}, 2, {"--seed is for --samples"});
  refused({"--cloud", job.mesh, "--refine", "1"}, 2, {"--refine", "clouds"});
  refused({"--cloud", job.mesh, "-s", "loop"}, 2, {"--scheme"});
  job.directory.write("in.csv", "x,y,z,weight\n0,0,0,1\n0,0,1,-1\n");
  refused({"--cloud", job.targets}, 3, {"in.csv:3", "weight -1"});
  job.directory.write("in.csv", "x,y,z\n");
  refused({"--cloud", job.targets}, 3, {"in.csv", "no points"});
  job.directory.write("in.csv", "x,y\n0,0\n");
  refused({"--cloud", job.targets}, 3, {"in.csv:1", "x,y,z[,weight]"});
}

TEST(CliFit, ConstructsPolygonsOfDualSchemes) {
  const Job job(cube(), normals_csv());
  const Outcome outcome =
      expect_done(job.fit({"-s", "doo-sabin", "--construct", "--size", ".4", "--report", job.path("fit.json")}));
  expect_parts(outcome.out, {"24 control points", "8 points and 7 normals", "does not keep vertices"});
  const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
  EXPECT_EQ(report["kind"], "construction");
  EXPECT_LE(report["normal_error"]["largest"].get<double>(), exact_normal);
  // The first target is the centroid of its face, and of a plane one.
  const Mesh fitted = read_mesh(job.output);
  const Topology topology(view(fitted));
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  const Face face{report["targets"]["carried_by"][0].get<Index>()};
  for (const Index v : topology.vertices(face)) centre += fitted.positions.row(v) / topology.size(face);
  EXPECT_LE((centre - corners.row(0)).norm(), exact_position);
  for (const Index v : topology.vertices(face))
    EXPECT_NEAR((fitted.positions.row(v) - corners.row(0)).dot(corner_normals.row(0)), 0, exact_position);
}

/// The sphere's data at the octahedron's vertices, on their number `count`.
std::string sphere_csv(Index count) {
  std::string text = "vertex,x,y,z,nx,ny,nz,k1,k2,d1x,d1y,d1z\n";
  const Points at = octahedron().positions;
  for (Index v = 0; v < count; ++v) {
    const Eigen::RowVector3d n = at.row(v), d(n.y(), n.z(), n.x());
    text += row(v, n) + row(v, n).substr(1) + ",-1,-1" + row(v, d).substr(1) + "\n";
  }
  return text;
}

TEST(CliFit, RefinesCurvaturesOfASphereToASphere) {
  const Job job(octahedron(), sphere_csv(6));
  const Outcome outcome = expect_done(
      job.fit({"-s", "torus-pieces", "-l", "2", "--report", job.path("fit.json"), "--picture", job.path("fit.svg")}));
  expect_parts(outcome.out, {"66 points, 128 faces; they keep 6 points, 6 normals and their curvatures",
                             "level 2: 128 triangles", "vertices 0 to 5"});
  const Points points = read_mesh(job.output).positions;
  EXPECT_EQ(points.topRows(6), octahedron().positions);
  EXPECT_LE((points.rowwise().norm().array() - 1).abs().maxCoeff(), reproduced);
  const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
  EXPECT_EQ(report["levels"].size(), 3u);
  EXPECT_EQ(report["curvature_error"]["count"], 6);
  const std::vector<DrawnPanel> panels = read_panels(read_file(job.path("fit.svg")));
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0].note, "6 points with normals and curvatures");
  EXPECT_EQ(panels[1].caption, "torus-pieces");
  EXPECT_EQ(panels[1].note, "level 2, 128 triangles");
}

TEST(CliFit, RefusesToLeaveASingularSystem) {
  const Job job(cube(), points_csv(corners));
  job.expect_refused({"-s", "catmull-clark", "--refine", "0"}, 3,
                     {"cage.obj: catmull-clark: ", "vertices 0, 1, 2, 3, 4, 5, 6, 7 depend on each other",
                      "rank 7 of 8", "another refinement", "--best-effort"});
  const Outcome outcome =
      expect_done(job.fit({"-s", "catmull-clark", "--refine", "0", "--best-effort", "--report", job.path("fit.json")}));
  expect_parts(outcome.out, {"the limit is near 8 points", "not met: ", "rank 7"});
  // What is told is what the limit misses.
  const double missed = (job.limit("catmull-clark") - corners).rowwise().norm().maxCoeff();
  const auto report = nlohmann::json::parse(read_file(job.path("fit.json")));
  EXPECT_GT(missed, 1e-3);
  EXPECT_NEAR(report["position_error"]["largest"].get<double>(), missed, exact_position);
}

TEST(CliFit, RefusesTargetsThatAreNone) {
  const auto refused = [](const std::string& csv, std::initializer_list<std::string_view> parts) {
    Job(cube(), csv).expect_refused({"-s", "catmull-clark"}, 3, parts);
  };
  refused("vertex,x,y\n", {"in.csv:1", "vertex,x,y,z[,nx,ny,nz"});
  refused("vertex,x,y,z\n8,0,0,0\n", {"in.csv:2", "vertex 8", "0 to 7"});
  refused("vertex,x,y,z\n1,0,0,0\n1,0,1,0\n", {"in.csv:3", "vertex 1", "line 2"});
  refused("vertex,x,y,z,nx,ny,nz,k1,k2,d1x,d1y,d1z\n1,0,0,0,0,0,1,1,1,1,0,0\n", {"in.csv", "torus-pieces"});
  refused("vertex,x,y,z,nx,ny,nz\n1,0,0,0,0,0,0\n", {"in.csv:2", "length 0"});
  refused("vertex,x,y,z\n1,nan,0,0\n", {"in.csv:2"});
  refused("face,u,v,x,y,z\n0,1.5,0,0,0,0\n", {"in.csv:2"});
  refused("face,u,v,x,y,z,weight\n0,0.5,0.5,0,0,0,0\n", {"in.csv", "all weights are 0"});
  refused("", {"in.csv"});
  Job(cube(), "vertex,x,y,z\n1,0,0,0\n")
      .expect_refused({"-s", "catmull-clark", "--refine", "40"}, 4, {"40 levels", "use at most"});
}

TEST(CliFit, RefusesIncompleteCurvatures) {
  const auto refused = [](const std::string& csv, std::initializer_list<std::string_view> parts) {
    Job(octahedron(), csv).expect_refused({"-s", "torus-pieces"}, 3, parts);
  };
  refused("vertex,x,y,z,nx,ny,nz,k1,k2,d1x,d1y,d1z\n1,0,0,0,0,0,1,1,1,1,0,1\n", {"in.csv:2", "tangent plane"});
  refused(sphere_csv(5), {"in.csv", "vertex 5 has no target", "torus-pieces"});
  refused(sphere_csv(5) + "5,0,0,1,0,0,1,,,,,\n", {"in.csv:7", "vertex 5 has no curvatures"});
  refused("face,u,v,x,y,z\n0,0,0,0,0,0\n", {"in.csv", "torus-pieces", "vertex,x,y,z,nx"});
}

TEST(CliFit, RefusesOptionsOfOtherFits) {
  const Job job(cube(), normals_csv());
  const auto refused = [&](const std::vector<std::string>& more, std::initializer_list<std::string_view> parts) {
    job.expect_refused(more, 2, parts);
  };
  refused({"-s", "catmull-clark", "--pin", "3"}, {"--pin", "targets at vertices"});
  refused({"-s", "catmull-clark", "--construct"}, {"--construct", "catmull-clark does not"});
  refused({"-s", "doo-sabin", "--size", ".2"}, {"--size is for --construct"});
  refused({"-s", "doo-sabin", "--construct", "--thin-plate", "1"}, {"--thin-plate", "--construct"});
  refused({"-s", "catmull-clark", "-l", "2"}, {"--levels", "targets at vertices"});
  refused({"-s", "catmull-clark", "--refine", "x"}, {"--refine x", "auto"});
  refused({"-s", "torus-pieces", "--refine", "1"}, {"--refine", "torus-pieces"});
  const Job places(cube(), "face,u,v,x,y,z\n0,0,0,0,0,0\n");
  const auto pins = [&](const char* pin, std::initializer_list<std::string_view> parts) {
    places.expect_refused({"-s", "catmull-clark", "--pin", pin}, 2, parts);
  };
  pins("3,3", {"vertex 3 is pinned twice"});
  pins("8", {"--pin 8", "0 to 7"});
  pins("3,x", {"--pin 3,x", "list of vertices"});
}

TEST(CliFit, RefusesOptionsAndSchemes) {
  const Job job(cube(), points_csv(corners));
  const auto refused = [&](const std::vector<std::string>& more, int status,
                           std::initializer_list<std::string_view> parts) { job.expect_refused(more, status, parts); };
  refused({"-s", "loop"}, 3, {"cage.obj: loop: ", "face 0"});
  refused({"-s", "lop"}, 2, {"unknown scheme 'lop'", "loop"});
  refused({"-s", "chaikin"}, 2, {"chaikin", "curves"});
  refused({"-s", "catmull-clark", "--thin-plate", "-1"}, 2, {"--thin-plate -1", "0 or more"});
  refused({"-s", "catmull-clark", "--membrane", "nan"}, 2, {"--membrane nan"});
  refused({"-s", "catmull-clark", "--report", "fit.txt"}, 2, {"fit.txt", ".json"});
  {
    const Job tagged(cube(), points_csv(corners));
    tagged.directory.write("cage.json", R"({"holeIndices": [0]})");
    const std::string report = tagged.path("cage.json");
    expect_failure(tagged.fit({"-s", "catmull-clark", "--report", report}), 2, {"cage.json", "holds tags"});
    EXPECT_EQ(read_file(report), R"({"holeIndices": [0]})");
  }
  refused({"-s", "catmull-clark", "--picture", job.path("none/fit.svg")}, 3, {"none", "not a directory"});
  expect_failure(sublimit({"fit", job.mesh, "--targets", job.path("none.csv"), "-s", "loop", "-o", job.output}), 3,
                 {"none.csv", "No such file"});
  expect_failure(sublimit({"fit", job.mesh, "--targets", job.targets, "-s", "catmull-clark", "-o", job.path("o.txt")}),
                 2, {"o.txt", ".obj or .ply"});
  EXPECT_EQ(job.directory.num_files(), 2);
}

}  // namespace
}  // namespace sublimit::testing

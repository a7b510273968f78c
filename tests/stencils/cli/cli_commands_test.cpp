// SPDX-License-Identifier: Apache-2.0
// What the program says and writes when all is well, or nearly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::json;

std::string write(const TemporaryDirectory& directory, const char* name, const Mesh& mesh) {
  write_obj(directory / name, mesh);
  return (directory / name).string();
}

/// Lines of a file that start with `keyword` and a blank.
std::vector<std::string> lines(const std::filesystem::path& path, const std::string& keyword) {
  std::istringstream text(read_file(path));
  std::vector<std::string> result;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(keyword + " ")) result.push_back(line);
  return result;
}

std::vector<Eigen::Vector3d> numbers(const std::vector<std::string>& lines) {
  std::vector<Eigen::Vector3d> result;
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string keyword;
    Eigen::Vector3d x;
    words >> keyword >> x[0] >> x[1] >> x[2];
    result.push_back(x);
  }
  return result;
}

TEST(CliSchemes, ListsAll) {
  const std::string text = expect_done(sublimit({"schemes"})).out;
  const Json json = Json::parse(expect_done(sublimit({"schemes", "--json"})).out);
  const std::vector<Scheme<double>> schemes = all_schemes();
  ASSERT_GE(json.size(), schemes.size());  // curve schemes follow
  for (size_t i = 0; i < schemes.size(); ++i) {
    EXPECT_EQ(json[i]["name"], schemes[i].name);
    EXPECT_EQ(json[i]["source"], schemes[i].source);
    EXPECT_EQ(json[i]["regular_continuity"], schemes[i].claims.regular);
    EXPECT_EQ(json[i]["options"].size(), schemes[i].options.size());
    for (const char* key : {"kind", "arity", "splits", "faces"}) EXPECT_TRUE(json[i].contains(key)) << key;
    expect_parts(text, {schemes[i].name, schemes[i].source, schemes[i].claims.limit});
  }
  expect_parts(text, {"triangles=catmark|smooth"});
}

TEST(CliInfo, Cube) {
  const TemporaryDirectory directory;
  const std::string mesh = write(directory, "cube.obj", cube());
  const Json json = Json::parse(expect_done(sublimit({"info", mesh, "-s", "catmull-clark", "--json"})).out);
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["edges"], 12);
  EXPECT_EQ(json["faces"], 6);
  EXPECT_EQ(json["euler_characteristic"], 2);
  EXPECT_EQ(json["components"], 1);
  EXPECT_EQ(json["boundary_loops"], 0);
  EXPECT_EQ(json["face_sizes"], Json({{"4", 6}}));
  EXPECT_EQ(json["interior_valences"], Json({{"3", 8}}));
  EXPECT_EQ(json["faults"], Json::array());
  EXPECT_EQ(json["boundary"], "edge-and-corner");
  EXPECT_EQ(json["scheme"]["takes_mesh"], "yes");
  expect_parts(expect_done(sublimit({"info", mesh})).out,
               {"8 vertices, 12 edges, 6 faces", "characteristic 2", "3 x 8", "no faults"});
  expect_parts(expect_no(sublimit({"info", mesh, "-s", "loop"})).out, {"face 0 has 4 corners"});
}

TEST(CliInfo, IntegralsOfTheLimit) {
  const TemporaryDirectory directory;
  const std::string closed = write(directory, "cube.obj", cube()), open = write(directory, "grid.obj", grid(2, 2));
  const Json json =
      Json::parse(expect_done(sublimit({"info", closed, "-s", "bilinear", "--limit", "--json"})).out)["limit"];
  constexpr double promised_area = 1e-10;  // as --help says
  EXPECT_NEAR(json["area"], 24, promised_area * 24);
  EXPECT_NEAR(json["solid"]["volume"], 8, rounding(100, 8));
  EXPECT_NEAR(json["solid"]["inertia"][1][1], 16. / 3, rounding(100, 8));
  EXPECT_EQ(json["has_solid"], "yes");
  EXPECT_EQ(json["solid"]["volume_error"], 0);
  expect_parts(expect_done(sublimit({"info", closed, "-s", "catmull-clark", "--limit"})).out,
               {"area  ", "volume  ", "centroid  ", "inertia  "});
  expect_parts(expect_done(sublimit({"info", open, "-s", "doo-sabin", "--limit"})).out,
               {"area  ", "volume             none: the surface is not closed at edge"});
  EXPECT_TRUE(
      Json::parse(expect_done(sublimit({"info", open, "-s", "doo-sabin", "--limit", "--json"})).out)["limit"]["solid"]
          .is_null());
  expect_parts(expect_no(sublimit({"info", closed, "-s", "loop", "--limit"})).out, {"face 0 has 4 corners"});
  expect_failure(sublimit({"info", closed, "--limit"}), 2, {"--limit", "-s SCHEME"});
  const std::vector<std::string> refined{"info", closed, "-s", "butterfly", "--triangulate", "--limit", "--json"};
  const Json solid = Json::parse(expect_done(sublimit(refined)).out)["limit"]["solid"];
  EXPECT_GT(solid["volume_error"], 0);
  constexpr double promised_volume = 1e-4;  // as README.md says
  EXPECT_LE(solid["volume_error"], promised_volume * double(solid["volume"]));
  EXPECT_GT(solid["inertia_error"], 0);
}

TEST(CliInfo, BoundariesTagsAndComponents) {
  const TemporaryDirectory directory;
  Mesh mesh = disjoint_union(grid(3, 3), grid(2, 2));
  add_crease(mesh, {5, 6}, 2);
  mesh.corners.push_back({5, 1});
  mesh.holes.push_back(4);
  mesh.boundary = Boundary::edge_only;
  mesh.creasing = Creasing::chaikin;
  const Json json = Json::parse(expect_done(sublimit({"info", write(directory, "mesh.obj", mesh), "--json"})).out);
  EXPECT_EQ(json["components"], 2);
  EXPECT_EQ(json["boundary_loops"], 2);
  EXPECT_EQ(json["euler_characteristic"], 2);
  EXPECT_EQ(json["creases"], 1);
  EXPECT_EQ(json["corners"], 1);
  EXPECT_EQ(json["holes"], 1);
  EXPECT_EQ(json["boundary"], "edge-only");
  EXPECT_EQ(json["creasing"], "chaikin");
  EXPECT_EQ(json["triangles"], "catmark");
}

TEST(CliInfo, ListsTwentyFaultsAndAllAsJson) {
  Mesh mesh = cube();
  mesh.positions.conservativeResize(8 + 30, 3);
  mesh.positions.bottomRows(30).setZero();
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", mesh);
  const Outcome text = expect_done(sublimit({"info", path}));
  EXPECT_EQ(count_of(text.out, "fault: "), 20u) << text.out;
  expect_parts(text.out, {"and 10 faults more"});
  EXPECT_EQ(Json::parse(expect_done(sublimit({"info", path, "--json"})).out)["faults"].size(), 30u);
}

struct Accepted {
  const char* name;
  Mesh mesh;
  const char* says;
};

TEST(CliWarnings, AcceptsWhatStrictRejectsNamingEachPlace) {
  Mesh isolated = cube();
  isolated.positions.conservativeResize(10, 3);
  isolated.positions.bottomRows(2).setZero();
  Mesh repeated = cube();
  repeated.face_sizes.push_back(4);
  repeated.face_vertices.insert(repeated.face_vertices.end(), {0, 1, 0, 2});
  for (const Accepted& accepted : {Accepted{"isolated", isolated, "vertex 8"}, Accepted{"repeated", repeated, "face 6"},
                                   Accepted{"winding", mobius_strip(5), "edge"}}) {
    SCOPED_TRACE(accepted.name);
    const TemporaryDirectory directory;
    const std::string out = (directory / "out.obj").string();
    const std::vector<std::string> arguments{
        "refine", write(directory, "mesh.obj", accepted.mesh), "-s", "catmull-clark", "-l", "1", "-o", out};
    const auto with = [&](const char* option) {
      std::vector<std::string> all = arguments;
      all.push_back(option);
      return all;
    };
    expect_failure(sublimit(with("--strict")), 3, {"mesh.obj", "--strict", accepted.says});
    EXPECT_EQ(directory.num_files(), 1);
    expect_parts(expect_done(sublimit(arguments), true).err, {"warning", "mesh.obj", accepted.says});
    EXPECT_EQ(directory.num_files(), 2);
    expect_done(sublimit(with("--quiet")));
  }
  const TemporaryDirectory directory;
  expect_failure(sublimit({"info", write(directory, "mesh.obj", isolated), "--strict"}), 3, {"vertex 8", "vertex 9"});
  expect_done(sublimit({"info", write(directory, "cube.obj", cube()), "--strict"}));
}

TEST(CliWarnings, AreAtMostFiveAndACount) {
  const TemporaryDirectory directory;
  std::string text = format_obj(cube());
  for (int i = 0; i < 9; ++i) text += "what" + std::string(size_t(i) + 1, 'x') + " 1 2 3\n";
  const std::string mesh = directory.write("mesh.obj", text).string();
  const Outcome outcome =
      expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "-o", (directory / "out.obj").string()}), true);
  EXPECT_EQ(count_of(outcome.err, "warning: " + mesh), 5u) << outcome.err;
  expect_parts(outcome.err, {"and 4 more"});
}

// Halstead, Kass, DeRose 1993 at valence 3: (9 v + 4 sum of neighbours + sum of face diagonals) / 24; at the corner
// (1,1,1) of the cube neighbours and diagonals sum to (1,1,1) and -(1,1,1): the limit is (1,1,1)/2, its normal is
// radial.
TEST(CliLimit, Cube) {
  const TemporaryDirectory directory;
  const std::string mesh = write(directory, "cube.obj", cube()), out = (directory / "limit.obj").string();
  const Outcome outcome = expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "--normals", "-o", out}));
  expect_parts(outcome.out, {"limit.obj", "8 limit points", "0 of 8 vertex sides without a normal"});
  EXPECT_EQ(count_of(outcome.out, "\n"), 1u);
  const auto x = numbers(lines(out, "v")), n = numbers(lines(out, "vn"));
  ASSERT_EQ(x.size(), 8u);
  ASSERT_EQ(n.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_LE((x[i] - cube().positions.row(Index(i)).transpose() / 2).norm(), eigen(10)) << i;
    EXPECT_LE((n[i] - x[i].normalized()).norm(), eigen(10)) << i;
  }
  expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "-l", "2", "--quiet", "-o", out}));
  EXPECT_EQ(lines(out, "v").size(), 98u);  // 6 * 16 faces, and 2 more
  EXPECT_EQ(lines(out, "vn").size(), 0u);
}

TEST(CliLimit, CreasesHaveANormalForEachSide) {
  Mesh mesh = cube();
  add_crease(mesh, {4, 5, 7, 6, 4}, 10);  // around the top
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", mesh);
  const std::filesystem::path obj = directory / "limit.obj", ply = directory / "limit.ply";
  expect_done(sublimit({"limit", path, "-s", "catmull-clark", "-l", "1", "--normals", "-o", obj.string()}));
  EXPECT_EQ(lines(obj, "v").size(), 26u);
  EXPECT_EQ(lines(obj, "vn").size(), 26u + 8);  // the crease has 8 vertices now
  expect_done(sublimit({"limit", path, "-s", "catmull-clark", "-l", "1", "--normals", "-o", ply.string()}));
  expect_parts(read_file(ply), {"property double nx"});
  EXPECT_EQ(read_mesh(ply).num_vertices(), 26);
}

TEST(CliLimit, LeavesHolesOut) {
  Mesh mesh = grid(4, 4);
  mesh.holes = {5};
  const TemporaryDirectory directory;
  const std::filesystem::path out = directory / "limit.obj";
  const std::string path = write(directory, "mesh.obj", mesh);
  expect_done(sublimit({"limit", path, "-s", "catmull-clark", "-l", "1", "-o", out.string()}));
  EXPECT_EQ(lines(out, "f").size(), 4u * 15);
  expect_done(sublimit({"limit", path, "-s", "catmull-clark", "--boundary", "none", "-o", out.string()}));
  EXPECT_EQ(lines(out, "f").size(), 3u);  // of the four inside, one is a hole
}

TEST(CliRefine, MatrixTimesControlPointsIsTheMesh) {
  const TemporaryDirectory directory;
  const Mesh mesh = jittered(polygon_ring({5, 4, 3, 6, 4}));
  const std::filesystem::path out = directory / "out.obj", mtx = directory / "out.mtx";
  expect_done(sublimit({"refine", write(directory, "mesh.obj", mesh), "-s", "catmull-clark", "-l", "2", "-o",
                        out.string(), "--matrix", mtx.string()}));
  const Points written = read_mesh(out).positions;
  std::istringstream text(read_file(mtx));
  std::string banner;
  std::getline(text, banner);
  EXPECT_EQ(banner, "%%MatrixMarket matrix coordinate real general");
  Index rows = 0, columns = 0, nonzeros = 0, count = 0;
  text >> rows >> columns >> nonzeros;
  ASSERT_EQ(rows, written.rows());
  ASSERT_EQ(columns, mesh.num_vertices());
  Points x = Points::Zero(rows, 3);
  double weight = 0;
  for (Index r = 0, c = 0; text >> r >> c >> weight; ++count) {
    ASSERT_TRUE(r >= 1 && r <= rows && c >= 1 && c <= columns);
    x.row(r - 1) += weight * mesh.positions.row(c - 1);
  }
  EXPECT_EQ(count, nonzeros);
  EXPECT_LE((x - written).cwiseAbs().maxCoeff(), rounding(8 * 4, diagonal(mesh.positions)));
}

TEST(CliRefine, TagsAreWrittenUnlessNotWanted) {
  Mesh mesh = cube();
  add_crease(mesh, {0, 1}, 2.5f);
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", mesh);
  const std::filesystem::path out = directory / "out.obj", ply = directory / "out.ply";
  expect_done(sublimit({"refine", path, "-s", "catmull-clark", "-l", "1", "-o", out.string()}));
  EXPECT_EQ(lines(out, "t crease").size(), 2u);
  expect_done(sublimit({"refine", path, "-s", "catmull-clark", "-l", "1", "-o", out.string(), "--no-tags"}));
  EXPECT_EQ(lines(out, "t").size(), 0u);
  const Outcome told =
      expect_done(sublimit({"refine", path, "-s", "catmull-clark", "-l", "1", "-o", ply.string()}), true);
  EXPECT_EQ(told.err,
            "sublimit: note: " + ply.string() +
                ": a PLY file has no place for creases; written as .obj, .usda, .usd or .usdz the mesh keeps them\n");
  EXPECT_EQ(read_mesh(ply).positions, read_mesh(out).positions);
  expect_done(sublimit({"refine", path, "-s", "catmull-clark", "-l", "1", "-o", ply.string(), "--no-tags"}));
}

TEST(CliOptions, FollowTheFileUnlessGiven) {
  Mesh mesh = grid(3, 3);
  mesh.boundary = Boundary::edge_only;
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", mesh);
  const std::filesystem::path out = directory / "out.obj";
  const auto first = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"refine", path, "-s", "catmull-clark", "-l", "1", "-o", out.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_done(sublimit(arguments));
    return read_mesh(out);
  };
  const Eigen::RowVector3d corner = mesh.positions.row(0);
  EXPECT_NE(first({}).positions.row(0), corner);  // rounded
  EXPECT_EQ(first({"--boundary", "edge-and-corner"}).positions.row(0), corner);
  EXPECT_EQ(first({"--boundary", "edge-and-corner"}).boundary, Boundary::edge_and_corner);
  EXPECT_EQ(first({"--creasing", "chaikin"}).creasing, Creasing::chaikin);
}

TEST(CliOptions, TrianglesAsTagAndAsOption) {
  Mesh mesh = octahedron();
  const TemporaryDirectory directory;
  const std::filesystem::path out = directory / "out.obj";
  const auto refined = [&](const char* scheme, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"refine",    write(directory, "mesh.obj", mesh), "-s", scheme, "-l", "1", "-o",
                                       out.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_done(sublimit(arguments));
    return read_mesh(out).positions;
  };
  const Points plain = refined("catmull-clark", {}), smooth = refined("catmull-clark", {"--triangles", "smooth"});
  EXPECT_NE(plain, smooth);
  EXPECT_EQ(refined("catmull-clark", {"--option", "triangles=smooth"}), smooth);
  mesh.triangles = Triangles::smooth;
  EXPECT_EQ(refined("catmull-clark", {}), smooth);
  EXPECT_EQ(refined("catmull-clark", {"--triangles", "catmark"}), plain);
  const Points loop = refined("loop", {});  // a tag that the scheme does not know is ignored
  mesh.triangles.reset();
  EXPECT_EQ(refined("loop", {}), loop);
}

TEST(CliOptions, SidecarOverridesTags) {
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", grid(3, 3));
  directory.write("mesh.json", R"({"holeIndices": [4], "interpolateBoundary": "edgeOnly"})");
  const Json json = Json::parse(expect_done(sublimit({"info", path, "--json"})).out);
  EXPECT_EQ(json["holes"], 1);
  EXPECT_EQ(json["boundary"], "edge-only");
}

TEST(CliOptions, ThreadsDoNotChangeABit) {
  const TemporaryDirectory directory;
  const std::string path = write(directory, "mesh.obj", jittered(torus(24, 24)));
  std::vector<std::string> texts;
  for (const char* threads : {"1", "2", "4"}) {
    const std::string out = (directory / "out.obj").string();
    expect_done(sublimit(
        {"limit", path, "-s", "catmull-clark", "-l", "2", "--normals", "--threads", threads, "--quiet", "-o", out}));
    texts.push_back(read_file(out));
  }
  EXPECT_TRUE(texts[0] == texts[1] && texts[1] == texts[2]);
}

TEST(CliDemo, WritesItsFilesAndElevenLines) {
  const TemporaryDirectory directory;
  const std::filesystem::path demo = directory / "a" / "demo";
  const Outcome outcome = expect_done(sublimit({"demo", demo.string()}));
  EXPECT_EQ(count_of(outcome.out, "\n"), 11u) << outcome.out;
  expect_parts(outcome.out, {"control.obj", "refined.obj", "limit.obj", "targets.csv", "samples.csv", "picture.svg"});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(demo), std::filesystem::directory_iterator()), 7);
  EXPECT_EQ(count_of(read_file(demo / "samples.csv"), "\n"), 1001u);
  EXPECT_GT(read_mesh(demo / "refined.obj").num_vertices(), 4 * read_mesh(demo / "control.obj").num_vertices());
  EXPECT_GT(lines(demo / "limit.obj", "vn").size(), lines(demo / "limit.obj", "v").size());
  const std::string picture = read_file(demo / "picture.svg");
  EXPECT_NE(picture.find("<svg"), std::string::npos);
  EXPECT_TRUE(picture.ends_with("</svg>\n"));
  EXPECT_LT(picture.size(), 700'000u);  // README.md shows it
  EXPECT_EQ(expect_done(sublimit({"demo", demo.string(), "--quiet", "--threads", "1"})).out, "");
}

}  // namespace
}  // namespace sublimit::testing

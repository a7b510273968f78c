// SPDX-License-Identifier: Apache-2.0
// `sublimit closest` and `sublimit intersect`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/formats/npy.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string write_cube(const TemporaryDirectory& directory) {
  write_obj(directory / "cube.obj", cube());
  return (directory / "cube.obj").string();
}

TEST(CliClosest, FindsTheFeetOnACube) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    points = directory.write("q.csv", "x,y,z\n0.25,0.5,3\n0,0,1\n2,2,2\n").string();
  const Outcome done = expect_done(sublimit({"closest", mesh, "-s", "bilinear", "--points", points, "-o", out}));
  expect_parts(done.out, {"3 points", "0 to 2"});
  // The box [-1,1]^3: above a face, on it, off a corner.
  EXPECT_TRUE(read_file(out).starts_with("face,u,v,x,y,z,nx,ny,nz,distance,lower,status\n"));
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_EQ(rows.size(), 4u);
  const std::vector<std::vector<double>> expected{{0.25, 0.5, 1, 2}, {0, 0, 1, 0}, {1, 1, 1, std::sqrt(3.0)}};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(csv_number(rows[i + 1][3 + k]), expected[i][k], found_distance);
    EXPECT_NEAR(csv_number(rows[i + 1][9]), expected[i][3], found_distance);
    EXPECT_NEAR(csv_number(rows[i + 1][10]), expected[i][3], found_distance);
  }
  EXPECT_EQ(csv_number(rows[1][8]), 1);  // the normal of the upper face
}

TEST(CliClosest, FindsSeveralFacesWithinARadiusAndSigns) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    points = directory.write("q.csv", "x,y,z\n0.5,0.25,0.9\n9,9,9\n0,0,3\n").string();
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"closest", mesh, "-s", "bilinear", "--points", points, "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    return expect_done(sublimit(all));
  };
  const Outcome near = run({"--nearest", "3", "--radius", "2"});
  expect_parts(near.out, {"3 points", "4 rows", "1 points have no face within 2"});
  EXPECT_TRUE(read_file(out).starts_with("point,face,u,v,x,y,z,nx,ny,nz,distance,lower,status\n"));
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_EQ(rows.size(), 5u);
  const std::vector<std::pair<double, double>> expected{{0, 0.1}, {0, 0.5}, {0, 0.75}, {2, 2}};
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(csv_number(rows[i + 1][0]), expected[i].first);
    EXPECT_NEAR(csv_number(rows[i + 1][10]), expected[i].second, found_distance);
  }
  run({"--signed"});
  const std::vector<CsvRow> with_signs = csv_rows(out);
  EXPECT_NEAR(csv_number(with_signs[1][9]), -0.1, found_distance);
  EXPECT_NEAR(csv_number(with_signs[3][9]), 2, found_distance);
}

TEST(CliClosest, TakesPointsFromEveryKindOfFile) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory);
  const Points q = cube().positions * 1.5;
  std::string csv = "x,y,z\n";
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    csv += std::to_string(q(i, 0)) + "," + std::to_string(q(i, 1)) + "," + std::to_string(q(i, 2)) + "\n";
  directory.write("q.csv", csv);
  Mesh large = cube();
  large.positions = q;
  write_obj(directory / "q.obj", large);
  NpyWriter npy(directory / "q.npy", DType::F64, {q.rows(), 3});
  npy.write(std::span<const double>(q.data(), size_t(q.size())));
  npy.commit();
  std::string first;
  for (const char* name : {"q.csv", "q.obj", "q.npy"}) {
    const std::string out = (directory / "o.csv").string();
    expect_done(sublimit(
        {"closest", mesh, "-s", "catmull-clark", "--points", (directory / name).string(), "-o", out, "--quiet"}));
    if (first.empty()) first = read_file(out);
    EXPECT_EQ(read_file(out), first) << name;
  }
}

TEST(CliClosest, RefusesInClearWords) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string();
  const auto refused = [&](const std::string& name, const std::string& text, int status,
                           std::initializer_list<std::string_view> parts) {
    const std::string points = directory.write(name, text).string();
    expect_failure(sublimit({"closest", mesh, "-s", "catmull-clark", "--points", points, "-o", out}), status, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused("a.csv", "", 3, {"a.csv"});
  refused("b.csv", "x,y\n1,2\n", 3, {"b.csv", "x,y,z"});
  refused("c.csv", "x,y,z\n1,nan,2\n", 3, {"c.csv:2"});
  refused("d.txt", "1 2 3\n", 3, {"d.txt", ".csv", ".npy"});
  refused("e.npy", "no array", 3, {"e.npy"});
  const std::string good = directory.write("q.csv", "x,y,z\n0,0,0\n").string();
  const auto wrong = [&](const std::string& option, const std::string& value) {
    expect_failure(sublimit({"closest", mesh, "-s", "catmull-clark", "--points", good, "-o", out, option, value}), 2,
                   {option + " " + value});
  };
  wrong("--nearest", "0"), wrong("--nearest", "few"), wrong("--radius", "-1"), wrong("--radius", "nan");
  write_obj(directory / "open.obj", grid(2, 2));
  expect_failure(sublimit({"closest", (directory / "open.obj").string(), "-s", "catmull-clark", "--points", good, "-o",
                           out, "--signed"}),
                 3, {"open.obj", "not closed at edge"});
  refused("none.csv", "x,y,z\n", 3, {"none.csv", "no points"});
  refused("names.csv", "a,b,c\n1,2,3\n", 3, {"names.csv", "x,y,z"});
  expect_failure(
      sublimit({"closest", mesh, "-s", "catmull-clark", "--points", (directory / "missing.csv").string(), "-o", out}),
      3, {"missing.csv"});
}

TEST(CliIntersect, FindsHitsOnACube) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    rays = directory
                               .write("r.csv",
                                      "ox,oy,oz,dx,dy,dz,tmin,tmax\n0.25,0.5,-3,0,0,2,,\n5,5,5,1,0,0,,\n"
                                      "0.25,0.5,-3,0,0,2,1.5,\n0.25,0.5,-3,0,0,2,,0.5\n")
                               .string();
  expect_done(sublimit({"intersect", mesh, "-s", "bilinear", "--rays", rays, "--all", "-o", out, "--quiet"}));
  EXPECT_TRUE(read_file(out).starts_with("ray,t,face,u,v,x,y,z,nx,ny,nz,status\n"));
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_EQ(rows.size(), 4u);
  const std::vector<std::vector<double>> expected{
      {0, 1, 0.25, 0.5, -1, -1}, {0, 2, 0.25, 0.5, 1, 1}, {2, 2, 0.25, 0.5, 1, 1}};
  for (size_t i = 0; i < 3; ++i) {
    const CsvRow& row = rows[i + 1];
    EXPECT_EQ(csv_number(row[0]), expected[i][0]);
    EXPECT_NEAR(csv_number(row[1]), expected[i][1], rounding(10));
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(csv_number(row[5 + k]), expected[i][2 + k], rounding(10));
    EXPECT_NEAR(csv_number(row[10]), expected[i][5], rounding(10));  // the box's normals point outwards
  }
  const Outcome nearest = expect_done(sublimit({"intersect", mesh, "-s", "bilinear", "--rays", rays, "-o", out}));
  expect_parts(nearest.out, {"2 hits of 4 rays"});
}

// Schemes without polynomials as well: in and out.
TEST(CliIntersect, FindsAllHitsOfClosedSurfaces) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n-5,0.1,0.2,1,0,0\n0.3,5,-0.1,0,-1,0.01\n")
                               .string();
  for (const char* scheme : {"butterfly", "modified-butterfly", "kobbelt", "sqrt3", "interpolatory-sqrt3"}) {
    const Outcome done =
        expect_done(sublimit({"intersect", mesh, "-s", scheme, "--triangulate", "--rays", rays, "--all", "-o", out}));
    expect_parts(done.out, {"4 hits of 2 rays\n"});
    EXPECT_EQ(csv_rows(out).size(), 5u) << scheme;
  }
}

TEST(CliIntersect, SaysWhereARayTouches) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n-3,0.3,1,1,0,0\n").string();
  const Outcome done = expect_done(sublimit({"intersect", mesh, "-s", "bilinear", "--rays", rays, "--all", "-o", out}));
  expect_parts(done.out, {"1 hits of 1 rays", "1 of them touch the surface", "status touching"});
  EXPECT_EQ(csv_rows(out)[1][11], "touching");
}

TEST(CliIntersect, SaysWhereARayWasGivenUp) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n-5,0.1,0.2,1,0,0\n9,9,9,1,0,0\n").string();
  const std::vector<std::string> command{"intersect", mesh, "-s", "kobbelt",      "--rays",
                                         rays,        "-o", out,  "--most-parts", "1"};
  const Outcome stopped = sublimit(command);
  EXPECT_EQ(stopped.status, 1);
  expect_parts(stopped.err, {"warning", "1 rays were given up", "given-up"});
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_GE(rows.size(), 2u);
  EXPECT_EQ(rows[1][0], "0");
  EXPECT_EQ(rows[1][11], "given-up");
  EXPECT_EQ(rows[1][8], "");  // no normal
  EXPECT_NEAR(csv_number(rows[1][5]), -5 + csv_number(rows[1][1]), rounding(10));
  for (const char* most : {"0", "many"})
    expect_failure(sublimit({"intersect", mesh, "-s", "kobbelt", "--rays", rays, "-o", out, "--most-parts", most}), 2,
                   {std::string("--most-parts ") + most});
}

TEST(CliIntersect, RefusesInClearWords) {
  const TemporaryDirectory directory;
  const std::string mesh = write_cube(directory), out = (directory / "o.csv").string();
  const auto refused = [&](const std::string& text, std::initializer_list<std::string_view> parts) {
    const std::string rays = directory.write("r.csv", text).string();
    expect_failure(sublimit({"intersect", mesh, "-s", "catmull-clark", "--rays", rays, "-o", out}), 3, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused("", {"r.csv"});
  refused("x,y,z\n", {"r.csv", "ox,oy,oz,dx,dy,dz"});
  refused("ox,oy,oz,dx,dy,dz\n0,0,0,0,0,0\n", {"r.csv:2", "direction"});
  refused("ox,oy,oz,dx,dy,dz\n0,0,0,1,nan,0\n", {"r.csv:2"});
  refused("ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,0,1,0,0,2,1\n", {"r.csv:2", "tmin 2 is above tmax 1"});
}

}  // namespace
}  // namespace sublimit::testing

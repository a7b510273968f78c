// SPDX-License-Identifier: Apache-2.0
// `sublimit sample`: what it writes is the exact limit, row for row; what it cannot take it refuses, and writes
// nothing.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/source/curvature.h"
#include "sublimit/stencils/files/random_samples.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Parts = std::initializer_list<std::string_view>;

Place sample_of(const CsvRow& row) { return {Index(csv_number(row[0])), csv_number(row[1]), csv_number(row[2])}; }

/// Three fields from `column` on; nothing if they are empty. Some but not all empty is a failure.
std::optional<Eigen::Vector3d> vector_of(const CsvRow& row, size_t column) {
  const bool absent = row.at(column).empty();
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(row.at(column + k).empty(), absent);
  if (absent) return std::nullopt;
  return Eigen::Vector3d(csv_number(row[column]), csv_number(row[column + 1]), csv_number(row[column + 2]));
}

/// A mesh in a directory, and the program on it.
class Sampling {
 public:
  explicit Sampling(const Mesh& mesh) : mesh_((directory / "mesh.obj").string()) { write_obj(mesh_, mesh); }
  Outcome run(const std::vector<std::string>& arguments, const std::string& scheme = "catmull-clark",
              const std::function<void()>& prepare = {}) const {
    std::vector<std::string> all{"sample", mesh_, "-s", scheme, "-o", out};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return sublimit(all, prepare);
  }
  /// Rows of the output, the header first.
  std::vector<CsvRow> rows(const std::vector<std::string>& arguments,
                           const std::string& scheme = "catmull-clark") const {
    expect_done(run(arguments, scheme));
    return csv_rows(out);
  }
  std::string at(const std::string& text) const { return directory.write("in.csv", text).string(); }

  TemporaryDirectory directory;

 private:
  std::string mesh_;

 public:
  const std::string out = (directory / "out.csv").string();
};

/// Cube with a crease around a face, a dart, a hole and a semi-sharp edge.
Mesh tagged_cube() {
  Mesh mesh = jittered(cube());
  add_crease(mesh, {0, 1, 3, 2, 0}, std::numeric_limits<float>::infinity());
  add_crease(mesh, {4, 5}, 1.5f);
  mesh.holes = {5};
  return mesh;
}

TEST(CliSample, FirstLineSaysTheColumns) {
  const Sampling on(cube());
  const std::string first = "face,u,v,status,x,y,z", last = ",nx,ny,nz\n", d1 = ",xu,yu,zu,xv,yv,zv",
                    d2 = ",xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv";
  const std::string in = on.at("face,u,v\n");  // no rows: a header alone
  for (const auto& [arguments, header] :
       {std::pair(std::vector<std::string>{}, first + last),
        {{"--derivatives", "0"}, first + last},
        {{"--derivatives", "1"}, first + d1 + last},
        {{"--derivatives", "2"}, first + d1 + d2 + last},
        {{"--derivatives", "2", "--curvature"}, first + d1 + d2 + ",nx,ny,nz,k1,k2,gauss,mean\n"}}) {
    std::vector<std::string> all{"--at", in};
    all.insert(all.end(), arguments.begin(), arguments.end());
    expect_parts(expect_done(on.run(all)).out, {"out.csv: 0 samples\n"});
    EXPECT_EQ(read_file(on.out), header);
  }
}

/// Every row against the stencil of its place, and what is there against `evaluate`.
TEST(CliSample, RowsAreTheStencilsOfTheirPlaces) {
  Mesh mesh = tagged_cube();
  for (const Mesh& control : {mesh, jittered(prism(5)), jittered(open_fan(5, 4, 2)), jittered(pole(3))}) {
    const Sampling on(control);
    const Scheme<double> scheme = find_scheme("catmull-clark").value();
    const Mesh read = read_obj(on.directory / "mesh.obj");
    const LimitMap surface(scheme, read);
    std::vector<Place> samples, random;
    RandomSamples(surface.addresses(), 200, 4).read(random, 200);
    samples = surface.grid(3);
    samples.insert(samples.end(), random.begin(), random.end());
    std::string text = "face,u,v\n";
    for (const Place& s : samples)
      text += format_number(s.face) + "," + format_number(s.u) + "," + format_number(s.v) + "\n";
    const std::vector<CsvRow> rows = on.rows({"--at", on.at(text), "--derivatives", "2", "--curvature"});
    ASSERT_EQ(rows.size(), samples.size() + 1);
    const LimitSamples found = surface.evaluate(read.positions, samples, 2);
    for (size_t i = 0; i < samples.size(); ++i) {
      const CsvRow& row = rows[i + 1];
      SCOPED_TRACE(row[0] + "," + row[1] + "," + row[2] + " " + row[3]);
      ASSERT_EQ(row.size(), 29u);
      const Place s = sample_of(row);
      EXPECT_TRUE(s.face == samples[i].face && s.u == samples[i].u && s.v == samples[i].v);
      const LimitStencil stencil = surface.stencil(s, 2);
      Points local(stencil.vertices.size(), 3);
      for (size_t j = 0; j < stencil.vertices.size(); ++j)
        local.row(Index(j)) = read.positions.row(stencil.vertices[j]);
      const Points expected = stencil.weights * local;
      const double terms = stencil.weights.cwiseAbs().rowwise().sum().maxCoeff() * double(stencil.vertices.size());
      for (Index k = 0; k < 6; ++k) {
        const auto value = vector_of(row, k == 0 ? 4 : size_t(4 + 3 * k));
        ASSERT_EQ(value.has_value(), k == 0 || found.order[i] >= (k < 3 ? 1 : 2));
        if (!value || k >= expected.rows()) continue;
        // At vertices of level 2 second derivatives are differences of sixteen times as much, on both ways.
        const double units = (k < 3 ? 16 : 64) * terms;
        EXPECT_LT((*value - Eigen::Vector3d(expected.row(k))).norm(), rounding(units, local.cwiseAbs().maxCoeff()));
      }
      const auto normal = vector_of(row, 22);
      EXPECT_EQ(row[3], name(found.status[i]));
      EXPECT_EQ(normal.has_value(), !found.normal.row(Index(i)).isZero(0));
      if (normal) {
        EXPECT_NEAR(normal->norm(), 1, rounding(4));
      }
      for (size_t k = 25; k < 29; ++k) EXPECT_EQ(row[k].empty(), !curvature(found, Index(i)));
    }
  }
}

/// Cubic B-splines of control values i^2 are x^2 + 1/3: a parabolic cylinder, whose curvature is known.
TEST(CliSample, CurvatureOfAParabolicCylinder) {
  Mesh mesh = grid(5, 5);
  for (Index i = 0; i < 36; ++i) {
    const double x = i % 6 - 2.0;
    mesh.positions.row(i) << x, i / 6, x * x;
  }
  const Sampling on(mesh);
  const std::vector<CsvRow> rows =
      on.rows({"--at", on.at("face,u,v\n12,0,0\n12,0.5,0.25\n12,1,1\n"), "--derivatives", "2", "--curvature"});
  ASSERT_EQ(rows.size(), 4u);
  for (size_t i = 1; i < 4; ++i) {
    const double x = csv_number(rows[i][1]), k = 2 / std::pow(1 + 4 * x * x, 1.5);
    EXPECT_EQ(rows[i][3], "regular");
    EXPECT_NEAR(csv_number(rows[i][4]), x, rounding(16, 4));
    EXPECT_NEAR(csv_number(rows[i][6]), x * x + 1.0 / 3, rounding(16, 9));
    const double expected[] = {k, 0, 0, k / 2};  // it bends towards its normal
    for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(csv_number(rows[i][25 + c]), expected[c], rounding(100, 9));
  }
}

TEST(CliSample, GridsAreRowMajorWithUFastest) {
  const Sampling squares(prism(5)), triangles(icosahedron());
  for (const bool whole : {false, true}) {
    const Sampling& on = whole ? triangles : squares;
    const std::string scheme = whole ? "loop" : "catmull-clark";
    const std::vector<CsvRow> rows = on.rows({"--grid", "4"}, scheme);
    EXPECT_EQ(rows.size(), 1u + (whole ? 20 * 10 : 15 * 16));
    const std::vector<Place> grid = LimitMap(find_scheme(scheme).value(), whole ? icosahedron() : prism(5)).grid(4);
    ASSERT_EQ(rows.size(), grid.size() + 1);
    for (size_t i = 0; i < grid.size(); ++i) {
      const Place s = sample_of(rows[i + 1]);
      EXPECT_TRUE(s.face == grid[i].face && s.u == grid[i].u && s.v == grid[i].v) << i;
    }
    EXPECT_EQ(rows[2][1], "0.3333333333333333");
    EXPECT_EQ(rows[2][2], "0");
  }
  // More than one batch.
  const std::vector<Place> grid = LimitMap(find_scheme("catmull-clark").value(), prism(5)).grid(70);
  ASSERT_GT(grid.size(), 70'000u);
  const std::vector<CsvRow> rows = squares.rows({"--grid", "70"});
  ASSERT_EQ(rows.size(), grid.size() + 1);
  for (size_t i = 0; i < grid.size(); ++i) {
    const Place s = sample_of(rows[i + 1]);
    ASSERT_TRUE(s.face == grid[i].face && s.u == grid[i].u && s.v == grid[i].v) << i;
  }
}

TEST(CliSample, RulesAreThoseAskedFor) {
  const Sampling open(grid(4, 4)), creased(tagged_cube()), cage(cube());
  const auto first = [](const Sampling& on, std::vector<std::string> rules) {
    rules.insert(rules.end(), {"--at", on.at("face,u,v\n0,0.125,0.25\n")});
    return on.rows(rules).at(1);
  };
  const CsvRow ends = first(open, {});
  EXPECT_EQ(first(open, {"--boundary", "edge-and-corner"}), ends);
  EXPECT_NE(first(open, {"--boundary", "edge-only"}), ends);
  EXPECT_EQ(first(open, {"--boundary", "none"})[3], "hole");
  const auto all = [](const Sampling& on, std::vector<std::string> rules) {
    rules.insert(rules.end(), {"--grid", "3"});
    return on.rows(rules);
  };
  EXPECT_NE(all(creased, {}), all(creased, {"--no-creases"}));
  EXPECT_EQ(all(creased, {}), all(creased, {"--creasing", "uniform"}));
  EXPECT_EQ(all(cage, {"--triangulate"}).size(), 1u + 36 * 9);
  EXPECT_NE(all(cage, {"--triangulate"}), all(cage, {"--triangulate", "--triangles", "smooth"}));
  EXPECT_NE(open.rows({"--grid", "3", "--option", "degree=3"}, "averaging"),
            open.rows({"--grid", "3", "--option", "degree=2"}, "averaging"));
}

TEST(CliSample, RandomPlacesBelongToTheSeed) {
  const Sampling on(jittered(cube()));
  std::vector<std::string> texts;
  for (const char* seed : {"7", "7", "8", "18446744073709551615"}) {
    expect_done(on.run({"--random", "500", "--seed", seed, "--quiet"}));
    texts.push_back(read_file(on.out));
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_NE(texts[0], texts[2]);
  EXPECT_NE(texts[2], texts[3]);
  expect_done(on.run({"--random", "500", "--quiet"}));
  const std::string unseeded = read_file(on.out);
  expect_done(on.run({"--random", "500", "--seed", "0", "--quiet"}));
  EXPECT_EQ(read_file(on.out), unseeded);
  expect_parts(expect_done(on.run({"--random", "0"})).out, {"0 samples\n"});
  EXPECT_EQ(read_file(on.out), "face,u,v,status,x,y,z,nx,ny,nz\n");
}

TEST(CliSample, ThreadsChangeNoBit) {
  const Sampling on(jittered(quads_from_triangles(icosahedron())));
  for (const char* count : {"3000", "150000"}) {  // by stencils, and by patches in more than one batch
    std::vector<std::string> texts;
    for (const char* threads : {"1", "2", "4"}) {
      expect_done(on.run({"--random", count, "--derivatives", "2", "--curvature", "--threads", threads, "--quiet"}));
      texts.push_back(read_file(on.out));
    }
    EXPECT_TRUE(texts[0] == texts[1] && texts[1] == texts[2]);
    EXPECT_EQ(count_of(texts[0], "\n"), size_t(std::atoi(count)) + 1);
  }
}

TEST(CliSample, StatusesAndWhatIsEmptyThere) {
  const auto row = [](const Mesh& mesh, const std::string& place, const std::string& scheme = "catmull-clark") {
    const Sampling on(mesh);
    const std::vector<CsvRow> rows =
        on.rows({"--at", on.at("face,u,v\n" + place + "\n"), "--derivatives", "2"}, scheme);
    EXPECT_EQ(rows.size(), 2u);
    return rows.at(1);
  };
  const auto present = [](const CsvRow& r) {  // position, first, second derivatives, normal
    std::string which;
    for (const size_t column : {4, 7, 10, 13, 16, 19, 22}) which += vector_of(r, column) ? '1' : '0';
    return which;
  };
  CsvRow r = row(torus(5, 5), "3,0,0");
  EXPECT_EQ(r[3], "regular");
  EXPECT_EQ(present(r), "1111111");
  r = row(cube(), "0,0,0");
  EXPECT_EQ(r[3], "extraordinary");
  EXPECT_EQ(present(r), "1000001");
  r = row(grid(3, 3), "0,0.5,0");
  EXPECT_EQ(r[3], "crease");
  EXPECT_EQ(present(r), "1111111");
  Mesh mesh = torus(5, 5);
  mesh.holes = {3};
  EXPECT_EQ(row(mesh, "3,0.5,0.5")[3], "hole");
  EXPECT_EQ(row(mesh, "4,0.5,0.5")[3], "regular");
  r = row(grid(3, 3), "0,0.5,0", "mid-edge");  // two tangents decay alike at its borders
  EXPECT_EQ(r[3], "undefined-normal");
  EXPECT_EQ(present(r), "1000000");
  r = row(jittered(triangle_torus(5, 5)), "3,0.3,0.3", "modified-butterfly");
  EXPECT_EQ(r[3], "unbounded-second");
  EXPECT_EQ(present(r).substr(0, 1), "1");
  EXPECT_EQ(present(r).substr(3, 3), "000");
}

TEST(CliSample, ClampMovesPlacesToTheRim) {
  const Sampling on(jittered(cube()));
  const std::string in = on.at("face,u,v\n0,0.5,0.5\n2,1.5,0.25\n3,-1,-7\n");
  expect_failure(on.run({"--at", in}), 3, {"in.csv:3", "(1.5, 0.25)", "outside", "square", "--clamp"});
  EXPECT_EQ(on.directory.num_files(), 2);
  expect_parts(expect_done(on.run({"--at", in, "--clamp"})).out, {"3 samples", "2 moved to the rim"});
  const std::vector<CsvRow> rows = csv_rows(on.out);
  EXPECT_TRUE(rows.at(2)[1] == "1" && rows.at(2)[2] == "0.25");
  EXPECT_TRUE(rows.at(3)[1] == "0" && rows.at(3)[2] == "0");
  const Sampling triangles(icosahedron());
  expect_failure(triangles.run({"--at", triangles.at("face,u,v\n0,0.5,0.75\n")}, "loop"), 3, {"in.csv:2", "triangle"});
  EXPECT_EQ(triangles.rows({"--at", triangles.at("face,u,v\n0,0.5,0.75\n"), "--clamp"}, "loop").at(1)[1], "0.375");
  expect_failure(on.run({"--at", on.at("face,u,v\n0,nan,0\n"), "--clamp"}), 3, {"in.csv:2", "nan", "finite"});
  expect_failure(on.run({"--at", on.at("face,u,v\n6,0,0\n"), "--clamp"}), 3, {"in.csv:2", "face 6", "0 to 5"});
}

TEST(CliSample, BadRowsAreNamedAndNothingIsWritten) {
  const Sampling on(cube());
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "in.csv: empty"},
           {"0,0,0\n", "in.csv:1: the first line"},
           {"u,v\n0,0\n", "in.csv:1: the first line"},
           {"segment,t\n0,0\n", "in.csv:1: the first line"},
           {"face,u,v\n0,0,0\n0,0\n", "in.csv:3: 2 fields"},
           {"face,u,v\n0,0,0\n0,0,0,0\n", "in.csv:3: 4 fields"},
           {"face,u,v\n0,nan,0\n", "in.csv:2: u is 'nan'"},
           {"face,u,v\n0,0,inf\n", "in.csv:2: v is 'inf'"},
           {"face,u,v\n0,0,zero\n", "in.csv:2: v 'zero'"},
           {"face,u,v\n6,0,0\n", "in.csv:2: face 6"},
           {"face,u,v\n-1,0,0\n", "in.csv:2: face -1"},
           {"face,u,v\n0.5,0,0\n", "in.csv:2: face '0.5'"},
           {"face,u,v\n0,1.0000000000000002,0\n", "in.csv:2: (u, v) = (1.0000000000000002, 0)"},
           {"face,u,v\n\n0,0,0\n", "in.csv:2: an empty line"},
           {std::string("\x7f"
                        "ELF\x02\0\0\0\xff\xfe",
                        10),
            "in.csv:1: the first line"}}) {
    const Outcome outcome = on.run({"--at", on.at(text)});
    expect_failure(outcome, 3, {part});
    EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
    EXPECT_EQ(on.directory.num_files(), 2);
  }
  // Far behind the first batch, when much has been written.
  std::string text = "face,u,v\n";
  for (int i = 0; i < 100'000; ++i) text += "1,0.5,0.5\n";
  expect_failure(on.run({"--at", on.at(text + "1,0.5\n")}), 3, {"in.csv:100002: 2 fields"});
  EXPECT_EQ(on.directory.num_files(), 2);
  expect_failure(on.run({"--at", (on.directory / "none.csv").string()}), 3, {"none.csv", "No such file"});
  expect_failure(on.run({"--at", on.directory.path().string()}), 3, {"directory"});
}

TEST(CliSample, BadCommandLines) {
  const Sampling on(cube());
  const std::string in = on.at("face,u,v\n0,0,0\n");
  const auto refused = [&](const std::vector<std::string>& arguments, int status, Parts parts,
                           const std::string& scheme = "catmull-clark") {
    const Outcome outcome = on.run(arguments, scheme);
    expect_failure(outcome, status, parts);
    EXPECT_EQ(on.directory.num_files(), 2);
  };
  refused({}, 2, {"--at", "--grid", "--random"});
  refused({"--at", in, "--grid", "3"}, 2, {"--at", "--grid", "one of them"});
  refused({"--grid", "3", "--random", "3"}, 2, {"one of them"});
  for (const char* N : {"1", "0", "-3", "three", "2.5", ""}) refused({"--grid", N}, 2, {"--"});
  for (const char* N : {"-1", "many", "1e3", "-99999999999999999999"}) refused({"--random", N}, 2, {"--random", N});
  refused({"--random", "3", "--seed", "-1"}, 2, {"--seed", "-1"});
  refused({"--random", "3", "--seed", "18446744073709551616"}, 2, {"--seed", "2^64"});
  refused({"--grid", "3", "--seed", "1"}, 2, {"--seed", "--random"});
  refused({"--grid", "3", "--clamp"}, 2, {"--clamp", "--at"});
  refused({"--grid", "3", "--curvature"}, 2, {"--curvature", "--derivatives 2"});
  refused({"--grid", "3", "--derivatives", "3"}, 2, {"derivatives", "3"});
  refused({"--grid", "3", "--closed"}, 2, {"--closed", "curves"});
  refused({"--grid", "3"}, 2, {"catmull-clarc", "catmull-clark"}, "catmull-clarc");
  refused({"--grid", "3"}, 3, {"no curves"}, "chaikin");
  refused({"--grid", "3"}, 3, {"mesh.obj", "4 corners", "loop"}, "loop");
  refused({"--grid", "3", "--option", "tension=1"}, 2, {"tension", "catmull-clark"});
  refused({"--grid", "3", "--triangles", "smooth"}, 2, {"triangles", "bilinear"}, "bilinear");
  expect_failure(sublimit({"sample", (on.directory / "mesh.obj").string(), "-s", "loop", "--grid", "3", "-o",
                           (on.directory / "out.obj").string()}),
                 2, {"out.obj", ".csv"});
  const Sampling tagged(tagged_cube());
  expect_failure(tagged.run({"--grid", "3"}, "doo-sabin"), 3, {"mesh.obj", "doo-sabin", "crease"});
  expect_done(tagged.run({"--grid", "3", "--no-creases"}, "doo-sabin"));
  expect_done(tagged.run({"--grid", "3", "--triangulate", "--boundary", "none", "--creasing", "chaikin"}, "loop"));
}

TEST(CliSample, SizesAreToldBeforeTheyAreTaken) {
  const Sampling on(cube());
  expect_failure(on.run({"--random", "1000000000000000000"}), 4,
                 {"--random 1000000000000000000", "of disk", "use fewer"});
  expect_failure(on.run({"--random", "99999999999999999999999"}), 4, {"of disk"});
  expect_failure(on.run({"--grid", "1000000"}), 4, {"--grid 1000000", "of memory", "use fewer"});
  expect_failure(on.run({"--grid", "99999999999999999999999"}), 4, {"of memory"});
  EXPECT_EQ(on.directory.num_files(), 1);
}

TEST(CliSample, FullDiskLeavesNothing) {
  const Sampling on(cube());
  const auto fill_disk = [] {
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  expect_failure(on.run({"--random", "100000"}, "catmull-clark", fill_disk), 4, {"out.csv", "cannot write"});
  EXPECT_EQ(on.directory.num_files(), 1);
}

/// Places come through a pipe, so that the program is at work when it is told to end.
TEST(CliSample, InterruptLeavesNothing) {
  const Sampling on(cube());
  const std::string pipe = (on.directory / "in.csv").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Program program({"sample", (on.directory / "mesh.obj").string(), "-s", "catmull-clark", "--at", pipe, "-o", on.out});
  std::signal(SIGPIPE, SIG_IGN);  // a program that ends too early shows below
  std::ofstream file(pipe);
  file << "face,u,v\n";
  for (int i = 0; i < 200'000; ++i) file << i % 6 << ",0.5,0.25\n";
  file.flush();
  EXPECT_EQ(on.directory.num_files(), 3);  // the output under its temporary name
  ::kill(program.id(), SIGINT);
  EXPECT_EQ(program.wait().status, 130);
  EXPECT_EQ(on.directory.num_files(), 2);
}

TEST(CliSample, EverySchemeRuns) {
  for (const Scheme<double>& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name);
    const Sampling on(jittered(cube()));
    std::vector<std::string> arguments{"--grid", "4", "--derivatives", "2", "--curvature"};
    if (scheme.face_size() == 3) arguments.push_back("--triangulate");
    const std::vector<CsvRow> rows = on.rows(arguments, scheme.name);
    ASSERT_EQ(rows.size(), 1u + (scheme.face_size() == 3 ? 12 * 10 : 6 * 16));
    for (size_t i = 1; i < rows.size(); ++i) {
      EXPECT_TRUE(vector_of(rows[i], 4)) << i;
      EXPECT_EQ(vector_of(rows[i], 22).has_value(), rows[i][3] != "undefined-normal") << i;
    }
  }
}

TEST(CliSample, InfoCountsTheFaces) {
  const Sampling on(prism(5));
  const std::string mesh = (on.directory / "mesh.obj").string();
  const auto addresses = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"info", mesh, "--json"});
    return nlohmann::json::parse(sublimit(arguments).out)["addresses"];
  };
  EXPECT_EQ(addresses({}), 15);
  EXPECT_EQ(addresses({"-s", "catmull-clark"}), 15);
  EXPECT_TRUE(addresses({"-s", "loop"}).is_null());  // which does not take it
  EXPECT_EQ(addresses({"-s", "loop", "--triangulate"}), 16);
  expect_parts(expect_done(sublimit({"info", mesh})).out, {"faces 0 to 14 of `sublimit sample`"});
}

/// The memory of a run does not grow with the file: a few batches or many take as much. SUBLIMIT_FULL: ten million
/// rows.
TEST(CliSample, LongFilesStreamInBoundedMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers keep memory that is given back";
#endif
  const Sampling on(torus(8, 8));
  const auto peak = [&](std::int64_t count) {
    std::ofstream file(on.directory / "in.csv");
    for (std::int64_t i = 0; i <= count; ++i) {
      if (i == 0)
        file << "face,u,v\n";
      else
        file << i % 64 << ",0." << i % 9973 << ",0." << i % 7919 << "\n";
    }
    file.close();
    const Outcome outcome =
        expect_done(on.run({"--at", (on.directory / "in.csv").string(), "--derivatives", "1", "--threads", "2"}));
    expect_parts(outcome.out, {"out.csv: " + std::to_string(count) + " samples"});
    EXPECT_GT(std::filesystem::file_size(on.out), 100 * std::uintmax_t(count));
    return outcome.peak_kb;
  };
  const bool full = std::getenv("SUBLIMIT_FULL") != nullptr;
  const long few = peak(200'000), many = peak(full ? 10'000'000 : 1'000'000);
  EXPECT_LT(many, few + 16 * 1024) << few << " KB";
  EXPECT_LT(many, 256 * 1024);
}

}  // namespace
}  // namespace sublimit::testing

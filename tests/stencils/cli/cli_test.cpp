// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: run as a process on files, judged by exit status, messages and what lies there
// afterwards.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "meshes/meshes.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Ending {
  int status = -1;
  std::string text;  ///< stdout and stderr
};

/// Runs the program; `file_limit` is the largest file it may write, in bytes.
Ending run(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY) {
  arguments.insert(arguments.begin(), SUBLIMIT_PROGRAM);
  int out[2];
  if (::pipe(out) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(out[1], 1);
    ::dup2(out[1], 2);
    ::close(out[0]);
    if (file_limit != RLIM_INFINITY) {
      const rlimit limit{file_limit, file_limit};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    _exit(127);
  }
  ::close(out[1]);
  Ending outcome;
  char buffer[4096];
  for (ssize_t n; (n = ::read(out[0], buffer, sizeof buffer)) > 0;) outcome.text.append(buffer, size_t(n));
  ::close(out[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  return outcome;
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

constexpr const char* quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Refining `text` fails with `status` and a message with all of `words`, and leaves no output behind.
void expect_cli_refused(const std::string& text, const std::string& scheme, int status,
                        const std::vector<std::string>& words, const std::vector<std::string>& more = {"-l", "1"}) {
  SCOPED_TRACE(text.substr(0, 200));
  const TemporaryDirectory directory;
  const auto mesh = directory.write("mesh.obj", text);
  std::vector<std::string> arguments{"refine", mesh.string(), "-s", scheme, "-o", (directory / "out.obj").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ending outcome = run(arguments);
  EXPECT_EQ(outcome.status, status) << outcome.text;
  for (const std::string& word : words) EXPECT_NE(outcome.text.find(word), std::string::npos) << outcome.text;
  EXPECT_EQ(directory.num_files(), 1) << "something was left behind";
}

TEST(Program, RefusesBadMeshesWithFileAndLine) {
  const std::string f = quad;
  expect_cli_refused("", "catmull-clark", 3, {"mesh.obj"});
  expect_cli_refused(std::string("\x7f\x45\x4c\x46\0\0\0\1\2\3", 10), "catmull-clark", 3, {"mesh.obj"});
  expect_cli_refused(f, "catmull-clark", 3, {"mesh.obj", "face"});  // no face at all
  expect_cli_refused(f + "f 0 1 2\n", "catmull-clark", 3, {"mesh.obj:5"});
  expect_cli_refused(f + "f 1 2 9\n", "catmull-clark", 3, {"mesh.obj:5", "9"});
  expect_cli_refused(f + "f -9 1 2\n", "catmull-clark", 3, {"mesh.obj:5", "-9"});
  expect_cli_refused(f + "f 1 2\n", "catmull-clark", 3, {"mesh.obj:5"});
  expect_cli_refused("v 0 nan 0\n" + f + "f 1 2 3\n", "catmull-clark", 3, {"mesh.obj:1"});
  expect_cli_refused("v 0 inf 0\n" + f + "f 1 2 3\n", "catmull-clark", 3, {"mesh.obj:1"});
  expect_cli_refused("v 0 1e999 0\n" + f + "f 1 2 3\n", "catmull-clark", 3, {"mesh.obj:1"});
  expect_cli_refused("v 0 x 0\n" + f + "f 1 2 3\n", "catmull-clark", 3, {"mesh.obj:1"});
  expect_cli_refused(f + "f 1 2 3 4\nt crease 2/1/0 0 2 1\n", "catmull-clark", 3, {"mesh.obj:6"},
                     {"-l", "1", "--strict"});
  expect_cli_refused(f + "f 1 2 3 4\nt crease 2/1/0 0 7 1\n", "catmull-clark", 3, {"mesh.obj:6"});
  expect_cli_refused(f + "f 1 2 3 4\nt crease 2/1/0 0 1\n", "catmull-clark", 3, {"mesh.obj:6"});
  expect_cli_refused(f + "f 1 2 3 4\nt corner 1/1/0 0 -2\n", "catmull-clark", 3, {"mesh.obj:6"});
  expect_cli_refused(f + "f 1 2 3 4\nt hole 1/0/0 5\n", "catmull-clark", 3, {"mesh.obj:6"});
}

TEST(Program, RefusesBadCommandLines) {
  const std::string good = std::string(quad) + "f 1 2 3 4\n";
  expect_cli_refused(good, "catmul-clark", 2, {"catmull-clark"});
  expect_cli_refused(good, "catmull-clark", 2, {"levels"}, {"-l", "-1"});
  expect_cli_refused(good, "catmull-clark", 2, {"boundary"}, {"-l", "1", "--boundary", "soft"});
  expect_cli_refused(good, "catmull-clark", 2, {"name=value"}, {"-l", "1", "--option", "triangles"});
  expect_cli_refused(good, "catmull-clark", 2, {"option"}, {"-l", "1", "--option", "tension=1"});
  expect_cli_refused(good, "bilinear", 2, {"triangles"}, {"-l", "1", "--triangles", "smooth"});
  expect_cli_refused(good, "catmull-clark", 4, {"memory", "32-bit"}, {"-l", "40"});
  expect_cli_refused(good, "loop", 3, {"face 0", "4 corners", "triangles"});
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"refin"}).status, 2);
}

TEST(Program, RefusesFilesThatAreNotThere) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "out.obj").string();
  EXPECT_EQ(run({"info", (directory / "none.obj").string()}).status, 3);
  EXPECT_EQ(run({"info", directory.path().string()}).status, 3);
  const std::string mesh = directory.write("mesh.obj", std::string(quad) + "f 1 2 3 4\n").string();
  const auto refine_to = [&](const std::string& path) {
    return run({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", path});
  };
  EXPECT_EQ(refine_to((directory / "out.dae").string()).status, 2);
  EXPECT_EQ(refine_to((directory / "none" / "out.obj").string()).status, 3);
  EXPECT_EQ(refine_to(mesh + "/out.obj").status, 3);         // below a file
  EXPECT_EQ(refine_to("/proc/sublimit_out.obj").status, 3);  // read-only, for root too
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(Program, LeavesNothingOnAFullDisk) {
  const TemporaryDirectory directory;
  const auto mesh = directory / "mesh.obj";
  write_mesh(mesh, torus(20, 20));
  const Ending outcome =
      run({"refine", mesh.string(), "-s", "catmull-clark", "-l", "3", "-o", (directory / "out.obj").string()}, 100000);
  EXPECT_EQ(outcome.status, 4) << outcome.text;
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(Program, AcceptsOddMeshesWithAWarningAndRejectsThemWhenStrict) {
  for (const auto& [text, word] : {std::pair<std::string, std::string>{"v 5 5 5\nf 1 2 3 4\n", "vertex 4"},
                                   {"v 5 5 5\nf 1 2 3 2 5\nf 1 2 3 4\n", "more than once"},
                                   {"v 0 0 1\nf 1 2 3\nf 1 2 5\nf 3 4 1\n", "same direction"}}) {
    const TemporaryDirectory directory;
    const auto mesh = directory.write("mesh.obj", quad + text);
    const std::vector<std::string> arguments{"refine", mesh.string(), "-s", "catmull-clark",
                                             "-l",     "1",           "-o", (directory / "out.obj").string()};
    const Ending accepted = run(arguments);
    EXPECT_EQ(accepted.status, 0) << accepted.text;
    EXPECT_NE(accepted.text.find("warning"), std::string::npos) << accepted.text;
    EXPECT_NE(accepted.text.find(word), std::string::npos) << accepted.text;
    std::vector<std::string> strict = arguments;
    strict.push_back("--strict");
    const Ending rejected = run(strict);
    EXPECT_EQ(rejected.status, 3);
    EXPECT_NE(rejected.text.find(word), std::string::npos) << rejected.text;
  }
}

// What is written is what refining goes on from: all boundary modes, holes, semi-sharp creases, Chaikin.
TEST(Program, RefiningTwiceByOneIsRefiningOnceByTwo) {
  int compared = 0;
  for (const NamedMesh& named : tagged_meshes()) {
    const std::string& name = named.name;
    const bool wanted = name == "boundary_none" || name == "boundary_edge_only" || name == "boundary_edge_and_corner" ||
                        name == "boundary_none_partly_sharpened" || name == "chain_uniform" ||
                        name == "chain_chaikin" || name == "holes_in_cube" || name == "holes_and_crease" ||
                        name == "star_3_infinite_uniform" || name == "boundary_tags" || name == "cubes_share_a_vertex";
    if (!wanted) continue;
    const TemporaryDirectory directory;
    const auto path = [&](const char* file) { return (directory / file).string(); };
    write_mesh(path("mesh.obj"), named.mesh);
    const auto refine_by = [&](const char* from, const char* levels, const char* to) {
      const Ending outcome =
          run({"refine", path(from), "-s", "catmull-clark", "-l", levels, "-o", path(to), "--quiet"});
      EXPECT_EQ(outcome.status, 0) << name << ": " << outcome.text;
    };
    refine_by("mesh.obj", "1", "one.obj");
    refine_by("one.obj", "1", "one_one.obj");
    refine_by("mesh.obj", "2", "two.obj");
    EXPECT_EQ(contents(path("one_one.obj")), contents(path("two.obj"))) << name;
    ++compared;
  }
  EXPECT_GE(compared, 9);
}

TEST(Program, WritesMatricesThatMakeItsMeshes) {
  const TemporaryDirectory directory;
  const auto path = [&](const char* file) { return (directory / file).string(); };
  const Mesh mesh = jittered(torus(4, 5));
  write_mesh(path("mesh.obj"), mesh);
  ASSERT_EQ(run({"refine", path("mesh.obj"), "-s", "catmull-clark", "-l", "2", "-o", path("out.obj"), "--matrix",
                 path("P.mtx")})
                .status,
            0);
  std::ifstream file(path("P.mtx"));
  std::string header;
  std::getline(file, header);
  EXPECT_EQ(header, "%%MatrixMarket matrix coordinate real general");
  Index rows, columns, count;
  file >> rows >> columns >> count;
  Points x = Points::Zero(rows, 3);
  ASSERT_EQ(columns, mesh.num_vertices());
  for (Index i = 0, r, c; i < count; ++i) {
    double w;
    file >> r >> c >> w;
    x.row(r - 1) += w * mesh.positions.row(c - 1);
  }
  EXPECT_TRUE(file.good());
  const Mesh refined = read_mesh(path("out.obj"));
  ASSERT_EQ(refined.num_vertices(), rows);
  EXPECT_LE((refined.positions - x).cwiseAbs().maxCoeff(), rounding(32, 9));  // sums in another order
}

TEST(Program, MovesVerticesToTheLimitWithNormals) {
  const TemporaryDirectory directory;
  const auto path = [&](const char* file) { return (directory / file).string(); };
  write_mesh(path("cube.obj"), cube());
  const Ending outcome = run({"limit", path("cube.obj"), "-s", "catmull-clark", "--normals", "-o", path("limit.obj")});
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  // Halstead 1993 at n = 3: (9 v + 4 sum e + sum f) / 24; a cube's corner (1,1,1): (9 + 4 + (-1)(...)) -> (9 + 4 - 1
  // ...)/24. Per coordinate: v = 1; e: 1, 1, -1; f: 1, -1, -1: (9 + 4 - 1) / 24 = 1/2.
  const Mesh limit = read_mesh(path("limit.obj"));
  EXPECT_LE((limit.positions.cwiseAbs().array() - 0.5).abs().maxCoeff(), rounding(18));
  EXPECT_NE(contents(path("limit.obj")).find("vn "), std::string::npos);
  EXPECT_EQ(
      run({"limit", path("cube.obj"), "-s", "catmull-clark", "-l", "2", "--normals", "-o", path("limit.ply")}).status,
      0);
  EXPECT_EQ(read_mesh(path("limit.ply")).num_vertices(), 98);
}

TEST(Program, DescribesSchemesAndMeshes) {
  const auto schemes = nlohmann::json::parse(run({"schemes", "--json"}).text);
  ASSERT_GE(schemes.size(), all_schemes().size());
  EXPECT_EQ(schemes[1]["name"], "catmull-clark");
  const TemporaryDirectory directory;
  write_mesh(directory / "cube.obj", cube());
  const Ending asked = run({"info", (directory / "cube.obj").string(), "-s", "loop", "--json"});
  EXPECT_EQ(asked.status, 1) << "Loop does not take quadrilaterals";
  const auto info = nlohmann::json::parse(asked.text);
  EXPECT_EQ(info["edges"], 12);
  EXPECT_EQ(info["euler_characteristic"], 2);
  EXPECT_EQ(info["interior_valences"]["3"], 8);
  EXPECT_NE(std::string(info["scheme"]["takes_mesh"]).find("4 corners"), std::string::npos);
}

TEST(Program, DemoMakesItsFilesAndSaysWhere) {
  const TemporaryDirectory directory;
  const Ending outcome = run({"demo", (directory / "demo").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  for (const char* file : {"control.obj", "refined.obj", "limit.obj", "samples.csv", "picture.svg"})
    EXPECT_TRUE(std::filesystem::exists(directory / "demo" / file)) << file;
  EXPECT_LE(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 11);
}

TEST(Program, HelpHasExamples) {
  for (const char* command : {"schemes", "info", "refine", "limit", "sample", "demo"}) {
    const Ending outcome = run({command, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.text.find("Examples:"), std::string::npos) << command;
  }
  EXPECT_NE(run({"--version"}).text.find("sublimit 0."), std::string::npos);
}

}  // namespace
}  // namespace sublimit::testing

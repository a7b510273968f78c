// SPDX-License-Identifier: Apache-2.0
// What the program tells while it works: each step of each subcommand, on a terminal and, where it is asked for, in a
// log.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

struct CliSteps : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  std::string mesh = path("mesh.obj");
  CliSteps() {
    write_obj(mesh, cube());
    directory.write("points.csv", "x,y,z\n0.3,0.4,0.2\n");
    directory.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n");
    directory.write("targets.csv", "vertex,x,y,z\n0,-1,-1,-1\n");
    directory.write(
        "cone.json",
        R"({"kind": "cone", "curve": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[1, 0], [0, 1]]}, "apex": [0, 0, 2]})");
    directory.write("ball.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})");
    expect_done(sublimit({"bake", mesh, "-s", "catmull-clark", "-l", "1", "-o", path("t.safetensors"), "--quiet"}));
  }
};

const auto always = [] { ::setenv("SUBLIMIT_PROGRESS", "always", 1); };

TEST_F(CliSteps, EverySubcommandTellsThem) {
  const struct {
    Words words;
    std::vector<std::string> steps;
  } rows[] = {
      {{"info", mesh, "-s", "catmull-clark", "--limit"}, {"reading " + mesh, "integrating over the limit"}},
      {{"info", path("cone.json"), "--limit"}, {"integrating over the patches"}},
      {{"refine", mesh, "-s", "catmull-clark", "-l", "2", "-o", path("o.obj")},
       {"reading ", "level 1 of 2", "level 2 of 2", "writing " + path("o.obj")}},
      {{"limit", mesh, "-s", "catmull-clark", "-o", path("o.obj")}, {"reading ", "limits", "writing "}},
      {{"sample", mesh, "-s", "catmull-clark", "--grid", "3", "-o", path("o.csv")}, {"reading ", "sampling"}},
      {{"closest", mesh, "-s", "catmull-clark", "--points", path("points.csv"), "-o", path("o.csv")},
       {"reading " + path("points.csv"), "reading " + mesh, "preparing the search", "searching for 1 points",
        "writing "}},
      {{"intersect", mesh, "-s", "catmull-clark", "--rays", path("rays.csv"), "-o", path("o.csv")},
       {"reading " + path("rays.csv"), "preparing the search", "tracing 1 rays", "writing "}},
      {{"tessellate", mesh, "-s", "catmull-clark", "--chord", "5%", "-o", path("o.obj")},
       {"reading ", "tessellating", "writing "}},
      {{"step", mesh, "-s", "catmull-clark", "-o", path("o.step")}, {"reading ", "making a shape", "writing "}},
      {{"bake", mesh, "-s", "catmull-clark", "-l", "1", "-o", path("o.safetensors")}, {"reading ", "writing "}},
      {{"construct", path("cone.json"), "-o", path("o.obj")}, {"reading ", "writing "}},
      {{"implicit", path("ball.json"), "--cells", "4", "--tolerance", "1", "-o", path("o.obj")},
       {"sampling the field", "writing "}},
      {{"apply", path("t.safetensors"), mesh, "-o", path("o.obj")}, {"reading ", "preparing ", "writing "}},
      {{"verify", path("t.safetensors")}, {"verifying "}},
      {{"export", path("t.safetensors"), "-o", path("o.mtx")}, {"reading ", "writing "}},
      {{"analyze", mesh, "-s", "catmull-clark", "-o", path("o.html")}, {"reading ", "analysing ", "drawing "}},
      {{"fit", mesh, "--targets", path("targets.csv"), "-s", "catmull-clark", "-o", path("o.obj")},
       {"reading ", "fitting", "writing "}},
      {{"demo", path("demo")}, {"... 0 s"}},
  };
  for (const auto& [words, steps] : rows) {
    SCOPED_TRACE(::testing::PrintToString(words));
    const Outcome outcome = sublimit(words, always);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const std::string& step : steps) expect_parts(outcome.err, {step});
    for (size_t at = 0; at < outcome.err.size(); at = outcome.err.find('\n', at) + 1)
      EXPECT_EQ(outcome.err.compare(at, 10, "sublimit: "), 0) << outcome.err;
    Words quiet = words;
    quiet.push_back("--quiet");
    EXPECT_EQ(sublimit(quiet, always).err, "");
  }
}

TEST_F(CliSteps, NothingIsToldOfShortWork) {
  EXPECT_EQ(sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", path("o.obj")}).err, "");
}

/// The line of a terminal is taken away at the end.
TEST_F(CliSteps, TerminalsHaveOneLine) {
  const int ours = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_GE(ours, 0);
  ASSERT_EQ(::grantpt(ours), 0);
  ASSERT_EQ(::unlockpt(ours), 0);
  const int theirs = ::open(::ptsname(ours), O_RDWR | O_NOCTTY | O_CLOEXEC);
  for (const auto& [words, step] :
       {std::pair{Words{"info", mesh, "-s", "catmull-clark", "--limit"}, "integrating over the limit"},
        std::pair{Words{"closest", mesh, "-s", "catmull-clark", "--points", path("points.csv"), "-o", path("o.csv")},
                  "searching for 1 points"}}) {
    Program program(words, always, theirs);
    EXPECT_EQ(program.wait().status, 0);
    std::string text(4096, '\0');
    text.resize(size_t(std::max<ssize_t>(::read(ours, text.data(), text.size()), 0)));
    expect_parts(text, {"\r\033[K" + std::string(step) + " ... 0 s"});
    EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  ::close(theirs);
  ::close(ours);
}

}  // namespace
}  // namespace sublimit::testing

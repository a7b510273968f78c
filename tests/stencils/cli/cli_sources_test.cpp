// SPDX-License-Identifier: Apache-2.0
// What may stand where MESH stands: a subcommand that does not take a kind of source says which it takes.
#include <gtest/gtest.h>

#include "stencils/cli_program.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(CliSources, SubcommandsSayWhichTheyTake) {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string polygon = directory.write("p.csv", "0,0\n1,1\n2,0\n").string();
  const std::string patch =
      directory
          .write("s.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n"
                 "parm u 0 1\nparm v 0 1\nend\n")
          .string();
  const std::string out = (directory / "o.obj").string();
  const char* const meshes = "takes meshes under a scheme with masks";
  expect_done(sublimit({"tessellate", patch, "--chord", "1", "-o", out}));
  expect_failure(sublimit({"bake", patch, "-l", "1", "--limit", "-o", (directory / "o.safetensors").string()}), 2,
                 {"--limit is for meshes"});
  const char* const either =
      "for meshes (see `sublimit schemes`), but not for an .obj with free-form curves or surfaces";
  expect_failure(sublimit({"tessellate", mesh, "--chord", "1", "-o", out}), 2,
                 {"-s SCHEME is missing", "`sublimit tessellate`", either});
  expect_failure(sublimit({"tessellate", polygon, "-s", "chaikin", "--chord", "1", "-o", out}), 2,
                 {"chaikin refines curves", "`sublimit tessellate`", meshes});
  expect_done(sublimit({"info", patch, "--limit"}));
  expect_failure(sublimit({"info", mesh, "--limit"}), 2, {"-s SCHEME is missing", "`sublimit info --limit`", either});
  const std::string points = directory.write("q.csv", "x,y,z\n0,0,0\n").string();
  expect_failure(sublimit({"closest", mesh, "-s", "nielson", "--points", points, "-o", (directory / "o.csv").string()}),
                 2, {"nielson", "no matrix", "`sublimit closest`", meshes, "recipes"});
  expect_failure(sublimit({"limit", mesh, "-s", "torus-pieces", "-o", out}), 2,
                 {"torus-pieces refines points with normals and curvatures", "`sublimit fit`"});
}

TEST(CliSources, OptionsAreThoseOfTheirKind) {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string out = (directory / "o.obj").string();
  expect_failure(sublimit({"limit", mesh, "-s", "nielson", "--creasing", "chaikin", "-o", out}), 2,
                 {"--creasing is for meshes", "nielson"});
  expect_failure(sublimit({"refine", mesh, "-s", "nielson", "--closed", "-l", "1", "-o", out}), 2,
                 {"--closed is for curves", "nielson"});
}

}  // namespace
}  // namespace sublimit::testing

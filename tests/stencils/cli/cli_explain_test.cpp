// SPDX-License-Identifier: Apache-2.0
// `sublimit sample --explain`: the way to the limit at one place, in words.
#include <gtest/gtest.h>

#include "stencils/cli_program.h"

namespace sublimit::testing {
namespace {

constexpr const char* cube_text =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

TEST(CliExplain, TellsTheWayToAPolynomialAndToAVertex) {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("cube.obj", cube_text).string();
  const std::vector<std::string> start{"sample", mesh, "-s", "catmull-clark", "--explain"};
  const auto explained = [&](const std::string& place) {
    std::vector<std::string> arguments = start;
    arguments.push_back(place);
    return expect_done(sublimit(arguments)).out;
  };
  const std::string inside = explained("0,0.3,0.45");
  expect_parts(inside, {"level", "quadrilateral", "0.3", "0.45", "child 0", "a polynomial of degree 3 in u and in v",
                        "status: regular", "weights of 8 control points", "their sum: 1", "point:"});
  EXPECT_EQ(count_of(inside, "eigenvalues"), 0u);
  const std::string vertex = explained("0,0,0");
  expect_parts(vertex, {"eigenvector", "eigenvalues at the corner: 1, 0.410097, 0.410097",
                        "the limit of vertex 0 (smooth)", "status: extraordinary"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(CliExplain, RefusesWhatIsNoPlace) {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("cube.obj", cube_text).string();
  for (const std::string place : {"1", "0,0", "0,0,0,0", "a,0,0", "0,0,x", "0.5,0,0", ",,"})
    expect_failure(sublimit({"sample", mesh, "-s", "catmull-clark", "--explain", place}), 2, {"--explain", "FACE,U,V"});
  expect_failure(sublimit({"sample", mesh, "-s", "catmull-clark", "--explain", "6,0,0"}), 2, {"6"});
  expect_failure(sublimit({"sample", mesh, "-s", "catmull-clark", "--explain", "0,2,0"}), 2, {"2"});
  expect_failure(sublimit({"sample", mesh, "-s", "catmull-clark", "--explain", "0,0,0", "--grid", "3", "-o", "x.csv"}),
                 2, {"--explain", "--grid"});
  expect_failure(sublimit({"sample", mesh, "-s", "catmull-clark", "--grid", "3"}), 2, {"-o"});
}

}  // namespace
}  // namespace sublimit::testing

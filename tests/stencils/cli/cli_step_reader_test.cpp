// SPDX-License-Identifier: Apache-2.0
// What `sublimit step` writes, read by a second reader: step_splines.py, which evaluates surfaces by SciPy and checks
// shells. Its points are searched for on the limit, or on the patches.
#include <gtest/gtest.h>

#include "meshes/free_form_shapes.h"
#include "meshes/meshes.h"
#include "stencils/cli/python_with_scipy.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "sublimit/io/detail/obj.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// `--tolerance` of caps where none is given, relative to the diagonal of the mesh.
constexpr double default_tolerance = 1e-5;

/// What the reader says of a file, and how far its points are from the surface at most.
struct Read {
  std::string said;
  double farthest = 0;
};
Read read_again(const TemporaryDirectory& directory, const std::string& shape, const std::vector<std::string>& scheme) {
  const std::string step = (directory / "o.step").string(), points = (directory / "points.csv").string(),
                    said = (directory / "said.txt").string(), out = (directory / "closest.csv").string();
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), scheme.begin(), scheme.end());
    expect_done(sublimit(arguments));
  };
  with({"step", shape, "-o", step});
  EXPECT_EQ(std::system((python_with_scipy() + " " + SUBLIMIT_SOURCE + "/tests/stencils/cli/step_splines.py " + step +
                         " 3 " + points + " > " + said)
                            .c_str()),
            0);
  with({"closest", shape, "--points", points, "-o", out});
  Read read{read_file(said)};
  const std::vector<CsvRow> rows = csv_rows(out);
  EXPECT_GT(rows.size(), 1u);
  for (size_t i = 1; i < rows.size(); ++i) read.farthest = std::max(read.farthest, csv_number(rows[i][9]));
  return read;
}

TEST(CliStepReader, ExactFacesAreTheLimit) {
  SUBLIMIT_NEEDS_SCIPY;
  Mesh creased = torus(6, 4);
  add_crease(creased, {0, 4, 8, 12, 16, 20, 0}, {10, 10, 10, 10, 10, 10});
  const std::vector<std::pair<std::string, Mesh>> cases{{"catmull-clark", torus(7, 5)},
                                                        {"catmull-clark", creased},
                                                        {"doo-sabin", torus(5, 4)},
                                                        {"loop", triangle_torus(4, 3)},
                                                        {"bilinear", cube()}};
  for (const auto& [scheme, mesh] : cases) {
    const TemporaryDirectory directory;
    write_obj(directory / "m.obj", mesh);
    const Read read = read_again(directory, (directory / "m.obj").string(), {"-s", scheme});
    EXPECT_LE(read.farthest, cad_exact * diagonal(mesh.positions)) << scheme;
    expect_parts(read.said, {"other 0\n", "closed 1\n"});
  }
}

TEST(CliStepReader, CapsAreWithinTheTolerance) {
  SUBLIMIT_NEEDS_SCIPY;
  const TemporaryDirectory directory;
  write_obj(directory / "m.obj", cube());
  const Read read = read_again(directory, (directory / "m.obj").string(), {"-s", "catmull-clark"});
  EXPECT_LE(read.farthest, default_tolerance * diagonal(cube().positions));
  EXPECT_GT(read.farthest, cad_exact);  // there are caps
  expect_parts(read.said, {"other 0\n", "closed 1\n"});
}

TEST(CliStepReader, PatchesAreThemselves) {
  SUBLIMIT_NEEDS_SCIPY;
  const TemporaryDirectory directory;
  FreeForm shapes = free_form_of({unit_sphere(), torus()});
  write_free_form(directory / "s.obj", shapes);
  const Read read = read_again(directory, (directory / "s.obj").string(), {});
  EXPECT_LE(read.farthest, cad_exact * diagonal(shapes.vertices.leftCols(3)));
  expect_parts(read.said, {"faces 2\n", "other 0\n", "closed 2\n"});
  write_free_form(directory / "pot.obj", teapot());
  const Read pot = read_again(directory, (directory / "pot.obj").string(), {});
  EXPECT_LE(pot.farthest, cad_exact * diagonal(teapot().vertices.leftCols(3)));
  expect_parts(pot.said, {"faces 32\n", "other 0\n"});
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// `step`: limits and patches as files of CAD programs, in one call.
#include "sublimit/cad/step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/patches/spline_surface.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(Step, WritesClosedLimitsAsSolids) {
  const TemporaryDirectory directory;
  const LimitSurface surface(cube(), "catmull-clark");
  const StepFile file = step(surface, directory / "cube.step", {.tolerance = 0.01});
  EXPECT_EQ(file.solids, 1);
  EXPECT_EQ(file.shells, 0);
  EXPECT_GT(file.caps, 0);
  EXPECT_GT(file.faces, 0);
  EXPECT_TRUE(file.met);
  EXPECT_LE(file.deviation, 0.01);
  EXPECT_TRUE(file.is_valid);
  EXPECT_EQ(directory.num_files(), 1);
  const StepFile exact = step(LimitSurface(torus(5, 4), "catmull-clark"), directory / "torus.brep");
  EXPECT_EQ(exact.caps, 0);
  EXPECT_EQ(exact.deviation, 0);
  EXPECT_EQ(exact.solids, 1);
}

TEST(Step, WritesAFaceForEachPatch) {
  const TemporaryDirectory directory;
  const auto bilinear = std::make_shared<const SplineSurface>(Knots<double>::open(1, 2, {0, 0, 1, 1}),
                                                              Knots<double>::open(1, 2, {0, 0, 1, 1}));
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0;
  const StepFile file =
      step(Patches(PatchSet(std::vector<std::shared_ptr<const Patch>>{bilinear}), points), directory / "saddle.step");
  EXPECT_EQ(file.faces, 1);
  EXPECT_EQ(file.solids, 0);
  EXPECT_TRUE(file.is_valid);
}

TEST(Step, RefusesWhatIsWrongAndLeavesNoFile) {
  const TemporaryDirectory directory;
  const LimitSurface surface(cube(), "catmull-clark");
  expect_error<InvalidOption>([&] { (void)step(surface, directory / "cube.obj"); }, {".step"});
  for (const double tolerance : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    expect_error<InvalidParameter>([&] { (void)step(surface, directory / "cube.step", {.tolerance = tolerance}); },
                                   {"tolerance"});
  expect_error<UnsupportedTopology>([&] { (void)step(LimitSurface(cube(), "kobbelt"), directory / "cube.step"); },
                                    {"kobbelt"});
  expect_error<InvalidMesh>([&] { (void)step(LimitSurface(Mesh(), "catmull-clark"), directory / "none.step"); },
                            {"no extent"});
  EXPECT_EQ(directory.num_files(), 0);
}

}  // namespace
}  // namespace sublimit::testing

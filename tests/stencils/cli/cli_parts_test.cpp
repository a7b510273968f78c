// SPDX-License-Identifier: Apache-2.0
// Parts of the program that are libraries of their own: what is said where they are not there.
#include <gtest/gtest.h>

#include <filesystem>

#include "optional_parts.h"
#include "stencils/cli_program.h"
#include "sublimit/io/obj.h"
#include "support/meshes.h"

namespace sublimit::testing {
namespace {

/// The program alone in a directory, as it is built where OpenCASCADE and OpenVDB are not.
Outcome alone(const TemporaryDirectory& directory, const std::vector<std::string>& arguments) {
  const std::filesystem::path copy = directory / "sublimit";
  std::filesystem::copy_file(SUBLIMIT_PROGRAM, copy, std::filesystem::copy_options::overwrite_existing);
  return Program(arguments, {}, -1, copy.c_str()).wait();
}

TEST(CliParts, MissingLibrariesAreNamedWithTheirPackagesAndHowToBuildThem) {
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", output(cube()));
  const std::string mesh = (directory / "cube.obj").string(), solid = (directory / "cube.step").string(),
                    cage = (directory / "cage.obj").string();
  const std::string field =
      directory.write("field.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})")
          .string();
  expect_failure(
      alone(directory, {"step", mesh, "-s", "catmull-clark", "-o", solid}), 2,
      {"CAD files", "libsublimit_opencascade.so", cad_part.packages, "SUBLIMIT_BUILD_CAD", ".ci/install-deps --all"});
  EXPECT_FALSE(std::filesystem::exists(solid));
  expect_failure(alone(directory, {"implicit", field, "-o", cage}), 2,
                 {"libsublimit_openvdb.so", implicit_mesh_part.packages, "SUBLIMIT_BUILD_IMPLICIT_MESH",
                  ".ci/install-deps --all"});
  EXPECT_FALSE(std::filesystem::exists(cage));
  EXPECT_NE(std::string(gpu_part.packages), "");
}

TEST(CliParts, LibrariesThatCannotBeLoadedAreAnErrorOfTheirOwn) {
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", output(cube()));
  directory.write("libsublimit_opencascade.so", "no library");
  expect_failure(alone(directory, {"step", (directory / "cube.obj").string(), "-s", "catmull-clark", "-o",
                                   (directory / "cube.step").string()}),
                 3, {"cannot load libsublimit_opencascade.so"});
}

}  // namespace
}  // namespace sublimit::testing

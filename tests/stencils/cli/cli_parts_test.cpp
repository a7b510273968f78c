// SPDX-License-Identifier: Apache-2.0
// Parts of the program that are libraries of their own: what is said where they are not there.
#include <gtest/gtest.h>

#include <filesystem>

#include "meshes/meshes.h"
#include "optional_parts.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

constexpr const char* opencascade_library = "libsublimit_opencascade.so";

/// The program alone in a directory, as it is built where OpenCASCADE and OpenVDB are not.
Outcome alone(const TemporaryDirectory& directory, const std::vector<std::string>& arguments) {
  const std::filesystem::path copy = directory / "sublimit";
  std::filesystem::copy_file(SUBLIMIT_PROGRAM, copy, std::filesystem::copy_options::overwrite_existing);
  return Program(arguments, {}, -1, copy.c_str()).wait();
}

TEST(CliParts, MissingLibrariesAreNamedWithTheirPackagesAndHowToBuildThem) {
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", cube());
  const std::string mesh = (directory / "cube.obj").string(), solid = (directory / "cube.step").string(),
                    cage = (directory / "cage.obj").string();
  const std::string field =
      directory.write("field.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})")
          .string();
  expect_failure(alone(directory, {"step", mesh, "-s", "catmull-clark", "-o", solid}), 2,
                 {"CAD files", opencascade_library, "sublimit-cad", cad_part.packages, "SUBLIMIT_BUILD_CAD",
                  ".ci/install-deps --all"});
  EXPECT_FALSE(std::filesystem::exists(solid));
  expect_failure(alone(directory, {"implicit", field, "-o", cage}), 2,
                 {"libsublimit_openvdb.so", "sublimit-implicit", implicit_mesh_part.packages,
                  "SUBLIMIT_BUILD_IMPLICIT_MESH", ".ci/install-deps --all"});
  EXPECT_FALSE(std::filesystem::exists(cage));
  const Outcome devices = alone(directory, {"devices"});
  EXPECT_EQ(devices.status, 0);
  for (const std::string part : {"libsublimit_gpu.so", "sublimit-gpu", gpu_part.packages, "SUBLIMIT_BUILD_GPU"})
    EXPECT_NE(devices.out.find(part), std::string::npos) << part << " in " << devices.out;
}

TEST(CliParts, LibrariesOfAnotherVersionAreRefused) {
  const std::filesystem::path built = std::filesystem::path(SUBLIMIT_PROGRAM).parent_path() / opencascade_library;
  if (!std::filesystem::exists(built)) return;  // a build without OpenCASCADE
  const std::string said = Program({"--version"}).wait().out;
  const std::string version = said.substr(said.find(' ') + 1, said.find('\n') - said.find(' ') - 1);
  std::string other = version, library = read_file(built.string());
  other.front() = '9';
  const std::string mark = '\0' + version + '\0';
  const size_t at = library.find(mark);
  ASSERT_NE(at, std::string::npos);
  library.replace(at + 1, other.size(), other);
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", cube());
  directory.write(opencascade_library, library);
  expect_failure(alone(directory, {"step", (directory / "cube.obj").string(), "-s", "catmull-clark", "-o",
                                   (directory / "cube.step").string()}),
                 3, {opencascade_library, "is of sublimit " + other, "this program is of sublimit " + version});
}

TEST(CliParts, LibrariesThatCannotBeLoadedAreAnErrorOfTheirOwn) {
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", cube());
  directory.write("libsublimit_opencascade.so", "no library");
  expect_failure(alone(directory, {"step", (directory / "cube.obj").string(), "-s", "catmull-clark", "-o",
                                   (directory / "cube.step").string()}),
                 3, {"cannot load libsublimit_opencascade.so"});
}

}  // namespace
}  // namespace sublimit::testing

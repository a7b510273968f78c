// SPDX-License-Identifier: Apache-2.0
// What CI does not test, it does not pass: the tests that may be skipped there are these, and why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "sublimit/base/detail/read_file.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

struct MaySkip {
  const char* reason;
  std::set<std::string> files;  ///< in tests/
};
const MaySkip may_skip[] = {
    {"programs that are missing: skipped on a desk, a failure in CI", {"support/skip.h"}},
    {"OpenSubdiv's regression shapes, meshes that fuzzing found and files that people reported are not ours to publish; a clone without "
     "../shared/meshes compares meshes of the tests' own",
     {"lib/every_ray_sweep_test.cpp", "lib/every_scheme_sweep_test.cpp", "lib/every_surface_sweep_test.cpp",
      "lib/fit/shared_meshes_fit_test.cpp", "lib/fit/shared_meshes_polygons_test.cpp",
      "stencils/formats/reported_files_test.cpp", "lib/primvar/opensubdiv_face_varying_test.cpp",
      "lib/shared_meshes_test.cpp", "stencils/report/asset/asset_shared_meshes_test.cpp", "stencils/bake/bake_test.cpp",
      "stencils/bake/one_origin_test.cpp", "stencils/cli/cli_found_limits_test.cpp", "stencils/cli/cli_found_test.cpp",
      "stencils/distributed/ranks_test.cpp", "stencils/gpu/baked_tables_test.cpp"}},
    {"a file system of 64 KB, mounted for one job, takes rights that containers may withhold",
     {"stencils/distributed/failures_test.cpp"}},
    {"the sanitizers keep memory that is given back, and need the address space that a limit takes away; other trees "
     "run these",
     {"stencils/cli/cli_apply_test.cpp", "stencils/cli/cli_errors_test.cpp", "stencils/cli/cli_sample_test.cpp"}},
    {"the sanitizers have allocators of their own, which are not counted; other trees run these",
     {"eval/allocation_test.cpp", "eval/gpu/failures_test.cpp", "lib/surface/limit_allocation_test.cpp",
      "lib/limit/poles_test.cpp"}},
    {"half floats are a feature that a GPU may lack; lavapipe, which CI has, does not",
     {"eval/gpu/gpu_evaluator_test.cpp"}},
    {"the largest shared meshes are for the full sweep (label full)", {"lib/surface/limit_map_truth_test.cpp"}},
};

const std::filesystem::path tests = SUBLIMIT_SOURCE "/tests";

/// Files in tests/ with a word, but for this one.
std::set<std::string> files_with(const std::string& word) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tests)) {
    const std::string name = entry.path().lexically_relative(tests).string(), kind = entry.path().extension().string();
    if (name == "stencils/skips_test.cpp") continue;
    if (kind != ".cpp" && kind != ".h" && kind != ".c" && kind != ".in" && kind != ".cmake" && kind != ".txt") continue;
    if (read_file(entry.path()).find(word) != std::string::npos) files.insert(name);
  }
  return files;
}

TEST(Skips, AreThoseOfTheListAndNoOthers) {
  std::set<std::string> listed;
  for (const MaySkip& kind : may_skip) listed.insert(kind.files.begin(), kind.files.end());
  EXPECT_EQ(files_with("GTEST_SKIP"), listed);
  for (const char* word : {"DISABLED", "SKIP_RETURN_CODE"})
    EXPECT_EQ(files_with(word), std::set<std::string>()) << word;
  // Of style.cmake, which looks for clang's programs: a failure in CI too.
  EXPECT_EQ(files_with("SKIP_REGULAR_EXPRESSION"), std::set<std::string>{"CMakeLists.txt"});
}

/// Tests that look for a program say so with SUBLIMIT_NEEDS_PROGRAM; they are looked for by how programs are looked
/// for.
TEST(Skips, NoTestThatNeedsAProgramPassesWithoutIt) {
  std::set<std::string> needing = files_with("SUBLIMIT_NEEDS_PROGRAM");
  needing.erase("support/skip.h");
  EXPECT_EQ(needing, (std::set<std::string>{"eval/gpu/engine_device_test.cpp", "stencils/cli/cli_manual_test.cpp",
                                            "stencils/cli/cli_tessellate_test.cpp", "stencils/cli/python_with_scipy.h",
                                            "stencils/files/export_table_test.cpp", "stencils/flatten_test.cpp",
                                            "stencils/formats/gltf_validator_test.cpp", "stencils/browser.h"}));
  std::set<std::string> looking = files_with("command -v");
  looking.merge(files_with("\"python3\""));
  EXPECT_TRUE(std::ranges::includes(needing, looking)) << "name the program with SUBLIMIT_NEEDS_PROGRAM";

  // This very program again, where none of Chromium, NumPy, VTK and Node.js is found.
  const TemporaryDirectory directory;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const auto run = [&](const std::string& variables) {
    const std::string command =
        "/usr/bin/env " + variables + " PATH=/nowhere PYTHONHOME=/nowhere '" + program +
        "' --gtest_filter='TableInPython.*:ReportPage.*InChromium:CliTessellate.*InVtk:GltfValidator.*' > '" +
        (directory / "out").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return std::pair(status, read_file(directory / "out"));
  };
  const auto [in_ci, failed] = run("CI=true");
  EXPECT_NE(in_ci, 0);
  EXPECT_NE(failed.find("6 FAILED TESTS"), std::string::npos) << failed;
  const auto [on_a_desk, skipped] = run("-u CI");
  EXPECT_EQ(on_a_desk, 0);
  EXPECT_NE(skipped.find("[  SKIPPED ] 6 tests"), std::string::npos) << skipped;
}

}  // namespace
}  // namespace sublimit::testing

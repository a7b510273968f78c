// SPDX-License-Identifier: Apache-2.0
// `sublimit export`: files of others appear, or a word about why not.
#include <gtest/gtest.h>

#include "stencils/cli_tables.h"

namespace sublimit::testing {
namespace {

TEST(CliExport, WritesEveryKind) {
  const Tables on(creased_cube());
  expect_done(on.bake({"-l", "1"}));
  for (const char* name : {"out.npz", "out.mtx"}) {
    expect_done(sublimit({"export", on.table, "-o", on.path(name)}));
    EXPECT_GT(std::filesystem::file_size(on.path(name)), 100u) << name;
  }
  EXPECT_TRUE(read_file(on.path("out.mtx")).starts_with("%%MatrixMarket"));
  expect_done(sublimit({"export", on.table, "-o", on.path("arrays")}));
  expect_done(sublimit({"export", on.table, "-o", on.path("slashed/")}));
  for (const char* name : {"arrays", "slashed"})
    EXPECT_TRUE(std::filesystem::exists(on.directory / name / "metadata.json")) << name;
}

TEST(CliExport, Refuses) {
  const Tables on(cube());
  expect_done(on.bake({"-l", "1"}));
  expect_failure(sublimit({"export", on.table, "-o", on.path("out.txt")}), 2, {"out.txt", ".npz"});
  expect_failure(sublimit({"export", on.path("none"), "-o", on.path("out.mtx")}), 3, {"none"});
  expect_failure(sublimit({"export", on.mesh, "-o", on.path("out.mtx")}), 3, {"mesh.obj"});
  expect_failure(sublimit({"export", on.table, "-o", on.path("nowhere/out.mtx")}), 3, {"nowhere"});
  EXPECT_EQ(on.directory.num_files(), 2);
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi` under any numbers of ranks: the same bits.
#include <gtest/gtest.h>

#include "stencils/distributed/run_ranks.h"
#include "sublimit/io/obj.h"
#include "support/meshes.h"

namespace sublimit::testing {
namespace {

TEST(Ranks, AnyNumberOfThemMakesTheSameBits) {
  ControlMesh creased = torus(7, 5);
  add_crease(creased, {0, 5, 10}, {10, 2.5f});
  for (const auto& [scheme, mesh] : {std::pair("catmull-clark", creased), std::pair("loop", triangle_torus(5, 4))}) {
    const TemporaryDirectory directory;
    const std::string obj = (directory / "m.obj").string(), npy = (directory / "o.npy").string();
    write_obj(obj, output(mesh));
    std::string one;
    for (const int ranks : {1, 2, 3, 4}) {
      const std::string shards = (directory / ("d" + std::to_string(ranks))).string();
      ASSERT_EQ(run_ranks(ranks, "bake " + obj + " -s " + scheme + " -l 2 -o " + shards).status, 0);
      for (const int appliers : {1, 3}) {
        ASSERT_EQ(run_ranks(appliers, "apply " + shards + " " + obj + " -o " + npy).status, 0);
        if (one.empty()) one = read_file(npy);
        EXPECT_EQ(read_file(npy), one) << scheme << " baked by " << ranks << ", applied by " << appliers;
        std::filesystem::remove(npy);
      }
    }
  }
}

TEST(Ranks, AnErrorOfOneEndsThemAll) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.npy").string();
  const RanksRun run = run_ranks(3, "apply " + (directory / "none").string() + " m.obj -o " + out);
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.error(), "sublimit-mpi: error: " + (directory / "none").string() +
                             "/shards.json: missing; it is written when all shards are there, so bake them first\n");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace sublimit::testing

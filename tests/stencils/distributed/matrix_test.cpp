// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

TEST(SpreadMatrix, IsAdjointToItsTransposeAndGoodForASolver) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string();
  int number = 0;
  for (const Mesh& mesh : {jittered(torus(9, 8)), disjoint_union(prism(5), cube())}) {
    write_obj(obj, mesh);
    const std::string shards = (directory / std::to_string(number++)).string();
    ASSERT_EQ(run_ranks(2, "bake " + obj + " -s catmull-clark -l 2 --shards 3 -o " + shards).status, 0);
    for (const int ranks : {1, 2, 3, 4}) {
      const RanksRun run = run_ranks(ranks, shards + " " + obj, "", 60, SUBLIMIT_MATRIX_DRIVER);
      EXPECT_EQ(run.status, 0) << ranks << " ranks: " << run.err;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing

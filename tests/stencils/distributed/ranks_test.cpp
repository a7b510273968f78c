// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi` under any numbers of ranks: the same bits.
#include <gtest/gtest.h>

#include <cstdlib>

#include "sublimit/base/read_file.h"
#include "sublimit/io/obj.h"
#include "support/meshes.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// The job by so many ranks, in so many seconds at most: one that hangs fails.
int ranks_run(int ranks, const std::string& arguments, const std::string& err = "/dev/null") {
  const std::string command =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_base_warn_component_unused=0 timeout 60 "
      "mpirun --oversubscribe -n " +
      std::to_string(ranks) + " " SUBLIMIT_MPI_PROGRAM " " + arguments + " > /dev/null 2> " + err;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

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
      ASSERT_EQ(ranks_run(ranks, "bake " + obj + " -s " + scheme + " -l 2 -o " + shards), 0);
      for (const int appliers : {1, 3}) {
        ASSERT_EQ(ranks_run(appliers, "apply " + shards + " " + obj + " -o " + npy), 0);
        if (one.empty()) one = read_file(npy);
        EXPECT_EQ(read_file(npy), one) << scheme << " baked by " << ranks << ", applied by " << appliers;
        std::filesystem::remove(npy);
      }
    }
  }
}

TEST(Ranks, AnErrorOfOneEndsThemAll) {
  const TemporaryDirectory directory;
  const std::string err = (directory / "err").string(), out = (directory / "o.npy").string();
  EXPECT_EQ(ranks_run(3, "apply " + (directory / "none").string() + " m.obj -o " + out, err), 3);
  EXPECT_NE(read_file(err).find("shards.json: cannot read"), std::string::npos) << read_file(err);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace sublimit::testing

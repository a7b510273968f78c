// SPDX-License-Identifier: Apache-2.0
// What jobs may take: the machine's memory, less where a control group or an option says so.
#include "sublimit/base/detail/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// The files by which Linux tells control groups.
class Groups {
 public:
  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = directory_ / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }
  double memory() const { return control_group_memory((directory_ / "").string()); }

 private:
  TemporaryDirectory directory_;
};

TEST(Memory, OfControlGroupsIsTheLeastOnTheWayUp) {
  const Groups groups;
  EXPECT_EQ(groups.memory(), INFINITY);
  groups.write("proc/self/cgroup", "0::/batch/job/step");
  groups.write("sys/fs/cgroup/batch/job/step/memory.max", "max");
  EXPECT_EQ(groups.memory(), INFINITY);
  groups.write("sys/fs/cgroup/batch/memory.max", "3000000000");
  EXPECT_EQ(groups.memory(), 3e9);
  groups.write("sys/fs/cgroup/batch/job/memory.max", "2000000000");
  groups.write("sys/fs/cgroup/elsewhere/memory.max", "1000");
  EXPECT_EQ(groups.memory(), 2e9);
}

TEST(Memory, OfControlGroupsOfTheFirstVersion) {
  const Groups groups;
  groups.write("proc/self/cgroup", "5:devices:/other\n4:cpuacct,memory:/batch/job\n0::/");
  groups.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  groups.write("sys/fs/cgroup/memory/other/memory.limit_in_bytes", "1000");
  groups.write("sys/fs/cgroup/memory/batch/job/memory.limit_in_bytes", "500000000");
  EXPECT_EQ(groups.memory(), 5e8);
}

TEST(Memory, OfAJobIsWhatItIsHeldTo) {
  struct Unlimited {
    ~Unlimited() { limit_memory(INFINITY); }
  } at_the_end;
  EXPECT_LT(memory_limit(), physical_memory());
  EXPECT_NE(memory_limit_in_words().find("this machine has "), std::string::npos);
  limit_memory(1e6);
  EXPECT_EQ(memory_limit(), 1e6);
  EXPECT_EQ(memory_limit_in_words(), "the limit is 1.0 MB");
  limit_memory(2 * physical_memory());
  EXPECT_EQ(memory_limit(), physical_memory());
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/standard_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/detail/read_file.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(StandardFiles, HaveTheNamesOfDevicesAndFormats) {
  const auto check = [](const char* path, int descriptor, const char* device, const char* extension) {
    const std::optional<StandardFile> found = standard_file(path);
    ASSERT_TRUE(found) << path;
    EXPECT_EQ(found->descriptor, descriptor);
    EXPECT_EQ(found->device, device);
    EXPECT_EQ(found->extension, extension);
    EXPECT_EQ(opened_path(path), device);
  };
  check("/dev/stdin", 0, "/dev/stdin", "");
  check("/dev/stdin.obj", 0, "/dev/stdin", ".obj");
  check("/dev/stdout.obj.gz", 1, "/dev/stdout", ".obj.gz");
  check("/dev/stderr.csv", 2, "/dev/stderr", ".csv");
  check("/dev/fd/63.off", 63, "/dev/fd/63", ".off");
  check("/proc/self/fd/7", 7, "/proc/self/fd/7", "");
  for (const char* const path : {"", "-", "stdin.obj", "/dev/null", "/dev/stdinx", "/dev/stdin/a.obj", "/dev/stdin.d/a",
                                 "/dev/fd/", "/dev/fd/x.obj", "/dev/fd/-1.obj", "/dev/fd/3x", "/dev/fd/99999999999"}) {
    EXPECT_FALSE(standard_file(path)) << path;
    EXPECT_EQ(opened_path(path), path);
  }
}

TEST(StandardFiles, AreReadAndWrittenByTheirDescriptor) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.write("file", "before ");
  const int file = ::open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
  const std::string name = "/dev/fd/" + std::to_string(file) + ".obj";
  for (const AtomicFile::Access access : {AtomicFile::Access::at_end, AtomicFile::Access::anywhere}) {
    AtomicFile out(name, {}, access);
    out.write("some text ");
    if (access == AtomicFile::Access::anywhere) out.rewrite(0, "more");
    out.commit();
  }
  EXPECT_EQ(read_file(name), "before some text more text ");
  EXPECT_EQ(map_file(name).bytes.size(), 27u);
  EXPECT_EQ(directory.num_files(), 1);
  ::close(file);
}

}  // namespace
}  // namespace sublimit::testing

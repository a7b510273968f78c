// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/atomic_file.h"

#include <gtest/gtest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "sublimit/base/detail/read_file.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(AtomicFile, HoldsWhatWasWrittenInPiecesOfAnySize) {
  const TemporaryDirectory directory;
  std::string expected;
  AtomicFile file(directory / "out");
  for (const std::size_t size : {1u, 100u, 3000000u, 5u, 1048576u, 0u, 1048575u, 2u}) {
    const std::string piece(size, static_cast<char>('a' + size % 26));
    file.write(piece);
    expected += piece;
  }
  file.commit();
  EXPECT_EQ(read_file(directory / "out"), expected);
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(AtomicFile, TargetStaysAsItWasUntilCommit) {
  const TemporaryDirectory directory;
  const std::filesystem::path target = directory.write("out", "old");
  {
    AtomicFile file(target);
    file.write(std::string(2000000, 'x'));
    EXPECT_EQ(read_file(target), "old");
    EXPECT_EQ(directory.num_files(), 2);
  }
  EXPECT_EQ(read_file(target), "old");
  EXPECT_EQ(directory.num_files(), 1);

  AtomicFile file(target);
  file.write("new");
  file.commit();
  EXPECT_EQ(read_file(target), "new");
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(AtomicFile, EmptyFileIsAFile) {
  const TemporaryDirectory directory;
  AtomicFile(directory / "out").commit();
  EXPECT_EQ(read_file(directory / "out"), "");
}

TEST(AtomicFile, KeepsPermissionsAndLinks) {
  const TemporaryDirectory directory;
  const std::filesystem::path target = directory.write("out", "old");
  std::filesystem::permissions(target, std::filesystem::perms(0640));
  std::filesystem::create_symlink("out", directory / "link");
  AtomicFile file(directory / "link");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
  EXPECT_EQ(read_file(target), "new");
  EXPECT_EQ(std::filesystem::status(target).permissions(), std::filesystem::perms(0640));
}

TEST(AtomicFile, WritesWhatALinkNamesThoughNothingIsThere) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "other");
  std::filesystem::create_symlink("second", directory / "first");
  std::filesystem::create_symlink("other/out", directory / "second");
  {
    AtomicFile file(directory / "first");
    file.write("lost");
  }
  EXPECT_FALSE(std::filesystem::exists(directory / "other/out"));
  AtomicFile file(directory / "first");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "second"));
  EXPECT_EQ(read_file(directory / "other/out"), "new");
  std::filesystem::create_symlink("round", directory / "circle");
  std::filesystem::create_symlink("circle", directory / "round");
  expect_error<IoError>([&] { AtomicFile out(directory / "circle"); }, {"circle: cannot write: Too many levels"});
  std::filesystem::create_symlink("none/out", directory / "lost");
  expect_error<IoError>([&] { AtomicFile out(directory / "lost"); }, {"lost: cannot write", "link to", "none/out"});
}

TEST(AtomicFile, TellsHowManyBytesAreWritten) {
  const TemporaryDirectory directory;
  std::vector<std::int64_t> told;
  AtomicFile file(directory / "out", [&](std::int64_t bytes) { told.push_back(bytes); });
  file.write("a few");
  file.write(std::string(10000000, 'x'));
  file.write("more");
  file.commit();
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GE(told.size(), 4u);  // pieces of some MB
  EXPECT_EQ(told.back(), 10000009);
}

TEST(AtomicFile, PipeThatNobodyReadsIsAnError) {
  const TemporaryDirectory directory;
  const std::filesystem::path pipe = directory / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::signal(SIGPIPE, SIG_IGN);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  AtomicFile file(pipe);
  file.write("taken");
  ::close(reader);
  expect_error<IoError>([&] { file.commit(); }, {"pipe: cannot write: Broken pipe"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(AtomicFile, LongNamesHaveATemporaryToo) {
  const TemporaryDirectory directory;
  const std::string name(255, 'n');
  AtomicFile(directory / name).commit();
  EXPECT_TRUE(std::filesystem::exists(directory / name));
}

TEST(AtomicFile, DevicesAreWrittenInPlace) {
  AtomicFile file("/dev/null");
  file.write("gone");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, SaysWhereItCannotWrite) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  expect_error<IoError>([&] { AtomicFile file(directory.path()); }, {directory.path().string(), "Is a directory"});
  expect_error<IoError>([&] { AtomicFile file(directory.path().string() + "/"); }, {"Is a directory"});
  expect_error<IoError>([&] { AtomicFile file(directory / "no/out"); },
                        {(directory / "no/out").string() + ": cannot write", "No such file", "directory must exist"});
  expect_error<IoError>([&] { AtomicFile file(directory / "file/out"); }, {"Not a directory"});
  expect_error<IoError>([&] { AtomicFile file("/proc/out"); }, {"/proc/out: cannot write"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(AtomicFile, FullDeviceIsALackOfResources) {
  expect_error<ResourceError>(
      [] {
        AtomicFile file("/dev/full");
        file.write("text");
        file.commit();
      },
      {"/dev/full: cannot write", "No space left on device"});
}

// Runs in a process of its own, with which the limit goes away.
[[noreturn]] void write_beyond_limit(const std::filesystem::path& target) {
  std::signal(SIGXFSZ, SIG_IGN);
  const ::rlimit limit{.rlim_cur = 100000, .rlim_max = 100000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  int status = 0;
  try {
    AtomicFile file(target);
    file.write(std::string(99999, 'x'));
    file.write("xx");
    file.commit();
  } catch (const Error& error) {
    std::fputs(error.what(), stderr);
    status = exit_status(error.code());
  }
  ::_exit(status);
}

TEST(AtomicFileDeathTest, FullDiskLeavesTheOldFileAndNoTemporary) {
  const TemporaryDirectory directory;
  const std::filesystem::path target = directory.write("out", "old");
  EXPECT_EXIT(write_beyond_limit(target), ::testing::ExitedWithCode(4), "out: cannot write: File too large");
  EXPECT_EQ(read_file(target), "old");
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(ReadFile, GivesEveryByte) {
  const TemporaryDirectory directory;
  std::string bytes(300000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  EXPECT_EQ(read_file(directory.write("bytes", bytes)), bytes);
  EXPECT_EQ(read_file(directory.write("empty", "")), "");
  EXPECT_FALSE(read_file("/proc/self/status").empty());  // says that its size is 0
}

TEST(ReadFile, SaysWhatCannotBeRead) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  expect_error<IoError>([&] { read_file(directory / "no.obj"); }, {"no.obj: cannot read: No such file or directory"});
  expect_error<IoError>([&] { read_file(directory.path()); }, {directory.path().string() + ": cannot read: Is a dir"});
  expect_error<IoError>([&] { read_file(directory / "file/x"); }, {"Not a directory"});
  expect_error<IoError>([&] { read_file(""); }, {"cannot read"});
}

}  // namespace
}  // namespace sublimit::testing

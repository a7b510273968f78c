// SPDX-License-Identifier: Apache-2.0
#pragma once
// Processes of one job, by MPI: what they ask each other for, and one file that all of them write.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace sublimit {

class Ranks {
 public:
  /// Once a process.
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  std::int64_t sum(std::int64_t own) const;
  /// Of the ranks before.
  std::int64_t sum_before(std::int64_t own) const;
  void wait() const;

  /// A job of all ranks. An error of one ends it for all: others may wait for the one.
  /// @return  the exit status; one line on stderr tells the error
  int run(const std::function<void()>& job) const;

 private:
  int rank_ = 0, size_ = 1;
};

/// A file that appears whole or not at all, written by all ranks at offsets of their own.
class SharedFile {
 public:
  /// @throws IoError  the first rank cannot make it
  SharedFile(const Ranks& ranks, const std::filesystem::path& target);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  /// @throws IoError, ResourceError
  void write(std::int64_t offset, const void* data, std::size_t bytes);
  /// All ranks have written: the file takes its name.
  void commit();

 private:
  const Ranks& ranks_;
  std::filesystem::path target_, temporary_;
  int file_ = -1;
};

/// Small files, whole or not at all.
void write_whole(const std::filesystem::path& path, const std::string& text);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// One file that all ranks write, by MPI-IO: it appears whole or not at all.
#include <mpi.h>

#include <filesystem>
#include <span>
#include <string_view>

#include "sublimit/distributed/ranks.h"

namespace sublimit {

class SharedFile {
 public:
  /// All ranks call. Room for all of it is taken at once, so that a full disk is told before any work. Of a link the
  /// file at its end is written; devices and pipes are refused.
  /// @param ranks  which must stay
  /// @throws IoError, ResourceError  on all ranks
  SharedFile(const Ranks& ranks, const std::filesystem::path& target, std::int64_t bytes);
  SharedFile(const Ranks&&, const std::filesystem::path&, std::int64_t) = delete;
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// By one rank, anywhere.
  /// @throws IoError, ResourceError  on this rank
  void write(std::int64_t offset, std::span<const std::byte> bytes);
  void write(std::int64_t offset, std::string_view text) { write(offset, std::as_bytes(std::span(text))); }
  void write(std::int64_t offset, std::span<const double> numbers) { write(offset, std::as_bytes(numbers)); }
  /// All ranks call, when all have written: the file takes its name.
  void commit();

 private:
  const Ranks& ranks_;
  std::filesystem::path target_;                   // as the caller named it
  std::filesystem::path destination_, temporary_;  // with links followed
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// One file that all ranks write, by MPI-IO. It appears whole or not at all.
#include <mpi.h>

#include <filesystem>
#include <span>
#include <string_view>

#include "sublimit/distributed/ranks.h"

namespace sublimit {

class SharedFile {
 public:
  /// Opens a temporary file beside the target and reserves its disk space, so that a full disk is reported
  /// before any work. If the target is a link, the file at its end is written; devices and pipes are refused.
  /// Collective: all ranks call.
  /// @param ranks  must outlive this
  /// @param bytes  size to reserve; the file may become larger
  /// @throws IoError, ResourceError  on all ranks
  SharedFile(const Ranks& ranks, const std::filesystem::path& target, std::int64_t bytes);
  SharedFile(const Ranks&&, const std::filesystem::path&, std::int64_t) = delete;
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Writes bytes at an offset; called by any single rank.
  /// @throws IoError, ResourceError  on this rank
  void write(std::int64_t offset, std::span<const std::byte> bytes);
  void write(std::int64_t offset, std::string_view text) { write(offset, std::as_bytes(std::span(text))); }
  void write(std::int64_t offset, std::span<const double> numbers) { write(offset, std::as_bytes(numbers)); }
  /// Renames the file to the target. Collective: all ranks call, after their last `write`.
  void commit();

 private:
  const Ranks& ranks_;
  std::filesystem::path target_;                   // as the caller named it
  std::filesystem::path destination_, temporary_;  // with links followed
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace sublimit

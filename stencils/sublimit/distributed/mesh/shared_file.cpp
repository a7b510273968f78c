// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/shared_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/followed_links.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// The temporary of the file that is open, for the handler of SIGTERM, with which mpirun ends the other ranks when one
/// was killed.
std::array<char, 4096> open_temporary{};

extern "C" void remove_temporary(int) {
  if (open_temporary[0] != 0) ::unlink(open_temporary.data());
  _exit(143);
}

void remember(const std::filesystem::path& temporary) {
  open_temporary[0] = 0;
  if (temporary.native().size() >= open_temporary.size()) return;
  std::memcpy(open_temporary.data(), temporary.c_str(), temporary.native().size() + 1);
}

void make_room(const std::filesystem::path& target, const std::filesystem::path& temporary, std::int64_t bytes) {
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw_file_error(target, "write", errno, errno == ENOENT ? "its directory must exist" : "");
  const int error = bytes > 0 && ::fallocate(file, 0, 0, bytes) != 0 ? errno : 0;
  ::close(file);
  if (error == 0 || error == EOPNOTSUPP || error == ENOSYS) return;
  ::unlink(temporary.c_str());
  throw_file_error(target, "write", error);
}

[[noreturn]] void throw_io_error(const std::filesystem::path& target, int error) {
  int kind = 0, length = 0;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  MPI_Error_class(error, &kind);
  MPI_Error_string(error, text.data(), &length);
  const std::string message = target.string() + ": cannot write: " + std::string(text.data(), size_t(length));
  if (kind == MPI_ERR_NO_SPACE || kind == MPI_ERR_QUOTA) throw ResourceError(message);
  throw IoError(message);
}

}  // namespace

SharedFile::SharedFile(const Ranks& ranks, const std::filesystem::path& target, std::int64_t bytes)
    : ranks_(ranks), target_(target), destination_(target) {
  std::signal(SIGTERM, remove_temporary);
  ranks.together([&] {
    if (!target_.has_filename() || std::filesystem::is_directory(target_))
      throw_file_error(target_, "write", EISDIR, "name a file");
    if (std::filesystem::exists(target_) && !std::filesystem::is_regular_file(target_))
      throw_file_error(target_, "write", ESPIPE, "ranks write at places of their own; name a file");
    destination_ = followed_links(target_);
    temporary_ = destination_.parent_path() / ("." + destination_.filename().string() + ".shared.tmp");
    remember(temporary_);
    if (ranks_.is_first()) make_room(target_, temporary_, bytes);
  });
  ranks.together([&] {
    // Each rank by itself: an error of one leaves no other waiting.
    const int error = MPI_File_open(MPI_COMM_SELF, temporary_.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_);
    if (error != MPI_SUCCESS) throw_io_error(target_, error);
  });
}

SharedFile::~SharedFile() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
  if (ranks_.is_first() && !temporary_.empty()) ::unlink(temporary_.c_str());
  remember({});
}

void SharedFile::write(std::int64_t offset, std::span<const std::byte> bytes) {
  constexpr size_t piece = size_t{1} << 28;  // MPI counts by int
  while (!bytes.empty()) {
    const size_t count = std::min(piece, bytes.size());
    MPI_Status status;
    const int error = MPI_File_write_at(file_, offset, bytes.data(), static_cast<int>(count), MPI_BYTE, &status);
    int done = 0;
    if (error == MPI_SUCCESS) MPI_Get_count(&status, MPI_BYTE, &done);
    if (error != MPI_SUCCESS) throw_io_error(target_, error);
    if (size_t(done) != count) throw_file_error(target_, "write", ENOSPC);
    offset += std::int64_t(count), bytes = bytes.subspan(count);
  }
}

void SharedFile::commit() {
  ranks_.together([&] {
    const int error = MPI_File_close(&file_);
    if (error != MPI_SUCCESS) throw_io_error(target_, error);
  });
  ranks_.together([&] {
    if (ranks_.is_first() && std::rename(temporary_.c_str(), destination_.c_str()) != 0)
      throw_file_error(target_, "write", errno);
    temporary_.clear();
  });
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Output that appears whole or not at all: written under a temporary name next to the target, renamed at the end.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/followed_links.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/detail/temporaries.h"

namespace sublimit {

/// A file being written. The target is unchanged until `commit()`; without it the temporary is removed.
///
/// Errors name the target and have the system's message: ResourceError for a full disk, else IoError. An existing
/// target keeps its permissions. A link stays a link: the file at its end is written, even if it does not exist yet.
/// Devices and pipes are written in place, and so is a standard stream ("/dev/stdout.ply", see standard_files.h), which
/// may be a file that others write, too. What standard output is given after its reader has closed it is dropped.
/// @note  Under a limit on file sizes the kernel sends SIGXFSZ, which kills the process; a program that ignores the
///        signal gets the error instead. A killed program leaves its temporary, ".NAME.PID-N.tmp"; one that exits
///        while it writes calls `Temporary::remove_all`.
/// @note  No fsync: the rename is atomic for every process, not against power failure.
class AtomicFile {
 public:
  /// Where bytes of the file may be written: at its end alone, or also before it, by `rewrite`.
  enum class Access { at_end, anywhere };

  /// Opens a temporary beside the target.
  /// @param progress  called with the number of bytes written so far, at least every 4 MB, if given
  explicit AtomicFile(const std::filesystem::path& target, std::function<void(std::int64_t)> progress = {},
                      Access access = Access::at_end)
      : target_(target), destination_(target), progress_(std::move(progress)) {
    if (const std::optional<StandardFile> stream = standard_file(target)) {
      file_ = ::fcntl(stream->descriptor, F_DUPFD_CLOEXEC, 3);
      if (file_ < 0) throw_file_error(target, "write", errno);
      drops_unread_ = stream->descriptor == STDOUT_FILENO;
      if (access == Access::anywhere) open_copy();
      return;
    }
    if (!target.has_filename()) throw_file_error(target, "write", EISDIR, "name a file");
    struct ::stat status {};
    const bool exists = ::stat(target.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) throw_file_error(target, "write", EISDIR, "name a file in it");
    if (exists && ::access(target.c_str(), W_OK) != 0) throw_file_error(target, "write", errno);
    if (exists && !S_ISREG(status.st_mode)) {
      file_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
      if (file_ < 0) throw_file_error(target, "write", errno);
      if (access == Access::anywhere) open_copy();
      return;
    }
    std::error_code unresolved;
    destination_ = exists ? std::filesystem::canonical(target, unresolved) : followed_links(target);
    if (unresolved) throw_file_error(target, "write", unresolved.value());
    const int error = temporary_.make_beside(destination_, [this](const char* name) {
      file_ = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      return file_ >= 0;
    });
    if (error != 0) {
      std::string remedy = destination_ == target_ ? "" : "it is a link to " + destination_.string();
      if (error == ENOENT) remedy += (remedy.empty() ? "" : "; ") + std::string("its directory must exist");
      throw_file_error(target_, "write", error, remedy);
    }
    if (exists) (void)!::fchmod(file_, status.st_mode & 07777);
  }

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() {
    for (const int file : {file_, in_place_})
      if (file >= 0) ::close(file);
  }

  /// Appends bytes. Small pieces are buffered, large ones written directly.
  void write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() > buffer_size) flush();
    if (bytes.size() >= buffer_size) {
      write_through(bytes);
    } else {
      if (buffer_.capacity() < buffer_size) buffer_.reserve(buffer_size);
      buffer_ += bytes;
    }
  }

  /// Returns true if the reader of standard output has closed it: nothing more will be written.
  bool is_dropped() const { return is_dropped_; }

  /// Replaces bytes that were written before, with access `anywhere`.
  void rewrite(std::int64_t at, std::string_view bytes) {
    flush();
    while (!bytes.empty()) {
      const ssize_t count = ::pwrite(file_, bytes.data(), bytes.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw_file_error(target_, "write", count < 0 ? errno : EIO);
      bytes.remove_prefix(std::size_t(count));
      at += count;
    }
  }

  /// Writes the rest of the buffer and renames the file to the target. Nothing may be written afterwards.
  void commit() {
    flush();
    if (in_place_ >= 0) write_copy();
    // Some file systems report a full disk only here; the descriptor is gone whatever close says.
    if (::close(std::exchange(file_, -1)) != 0) throw_file_error(target_, "write", errno);
    if (temporary_.empty()) return;
    if (std::rename(temporary_.name().c_str(), destination_.c_str()) != 0) throw_file_error(target_, "write", errno);
    temporary_.forget();
  }

 private:
  // A call to the system is cheap beside so many bytes, and they are still in the cache when it copies them.
  static constexpr std::size_t buffer_size = std::size_t{1} << 16;
  static constexpr std::size_t largest_piece = std::size_t{1} << 22;

  void flush() {
    write_through(buffer_);
    buffer_.clear();
  }

  // Bytes before the end cannot be replaced in a pipe: they are kept in a file without a name until all are there.
  void open_copy() {
    std::error_code failed;
    const std::filesystem::path directory = std::filesystem::temp_directory_path(failed);
    in_place_ = std::exchange(file_, ::open(failed ? "/tmp" : directory.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600));
    if (file_ < 0) throw_file_error(directory, "write", errno, "TMPDIR should name a directory for temporary files");
  }

  void write_copy() {
    const int copy = std::exchange(file_, std::exchange(in_place_, -1));
    in_place_ = copy;  // to be closed, whatever happens
    std::array<char, buffer_size> block;
    for (off_t at = 0;;) {
      const ssize_t count = ::pread(copy, block.data(), block.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw_file_error(target_, "write", errno);
      if (count == 0) break;
      write_through({block.data(), std::size_t(count)});
      at += count;
    }
  }

  void write_through(std::string_view bytes) {
    while (!bytes.empty() && !is_dropped_) {
      const ssize_t count = ::write(file_, bytes.data(), std::min(bytes.size(), largest_piece));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) {  // whoever shares the pipe made it so
        pollfd ready{file_, POLLOUT, 0};
        ::poll(&ready, 1, -1);
        continue;
      }
      if (count < 0 && errno == EPIPE && drops_unread_) {
        is_dropped_ = true;
        break;
      }
      if (count <= 0) throw_file_error(target_, "write", count < 0 ? errno : EIO);
      bytes.remove_prefix(std::size_t(count));
      written_ += count;
      if (progress_) progress_(written_);
    }
  }

  std::filesystem::path target_;       // as the caller named it
  std::filesystem::path destination_;  // with links resolved
  Temporary temporary_;                // none: written in place, or already renamed
  int file_ = -1;
  int in_place_ = -1;          // the target, while `file_` is a copy of its bytes
  bool drops_unread_ = false;  // once its reader has closed it
  bool is_dropped_ = false;
  std::string buffer_;
  std::int64_t written_ = 0;
  std::function<void(std::int64_t)> progress_;
};

}  // namespace sublimit

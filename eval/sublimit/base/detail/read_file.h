// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading a whole file.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"

namespace sublimit {

/// Returns the bytes of a file, or of a standard stream (standard_files.h). Pipes and devices are read to their end.
/// @throws IoError  missing, a directory, unreadable;  ResourceError  larger than memory
/// @param most  bytes after which reading stops: the result has one more where the file goes on
inline std::string read_file(const std::filesystem::path& path,
                             std::size_t most = std::numeric_limits<std::size_t>::max() - 1) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  };
  const Descriptor file{::open(opened_path(path).c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) throw_file_error(path, "read", errno);
  struct ::stat status {};
  if (::fstat(file.number, &status) != 0) throw_file_error(path, "read", errno);
  if (S_ISDIR(status.st_mode)) throw_file_error(path, "read", EISDIR, "name a file in it");

  std::string bytes;
  std::size_t size = 0;
  try {
    // One byte more than the size, so that the end of the file shows without growing; /proc and pipes say 0.
    bytes.resize(std::min(most + 1, S_ISREG(status.st_mode) && status.st_size > 0 ? std::size_t(status.st_size) + 1
                                                                                  : std::size_t{1} << 16));
    for (;;) {
      const ssize_t got = ::read(file.number, bytes.data() + size, bytes.size() - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw_file_error(path, "read", errno);
      if (got == 0) break;
      size += std::size_t(got);
      if (size > most) break;
      if (size == bytes.size()) bytes.resize(size > most / 2 ? most + 1 : 2 * size);
    }
  } catch (const std::bad_alloc&) {
    throw ResourceError(path.string() + ": does not fit into memory");
  } catch (const std::length_error&) {
    throw ResourceError(path.string() + ": does not fit into memory");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace sublimit

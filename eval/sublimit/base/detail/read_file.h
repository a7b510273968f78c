// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading a whole file.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/error.h"

namespace sublimit {

/// Returns the bytes of a file. Pipes and devices are read to their end.
/// @throws IoError  missing, a directory, unreadable;  ResourceError  larger than memory
inline std::string read_file(const std::filesystem::path& path) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  };
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) throw_file_error(path, "read", errno);
  struct ::stat status {};
  if (::fstat(file.number, &status) != 0) throw_file_error(path, "read", errno);
  if (S_ISDIR(status.st_mode)) throw_file_error(path, "read", EISDIR, "name a file in it");

  std::string bytes;
  std::size_t size = 0;
  try {
    // One byte more than the size, so that the end of the file shows without growing; /proc and pipes say 0.
    bytes.resize(S_ISREG(status.st_mode) && status.st_size > 0 ? std::size_t(status.st_size) + 1 : 1 << 16);
    for (;;) {
      const ssize_t got = ::read(file.number, bytes.data() + size, bytes.size() - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw_file_error(path, "read", errno);
      if (got == 0) break;
      size += std::size_t(got);
      if (size == bytes.size()) bytes.resize(2 * size);
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

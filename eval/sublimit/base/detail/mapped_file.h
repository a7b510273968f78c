// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files mapped into memory: pages are read from the disk when they are first used.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/standard_files.h"

namespace sublimit {

/// Bytes that are valid while the owner exists.
struct MappedFile {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

/// Maps a file for reading; pipes and devices are read to their end instead.
/// @note  If another process truncates the file, reading the pages that it cut off kills this process. `AtomicFile`
///        replaces files as a whole, which leaves mapped ones unchanged.
/// @throws IoError  missing, a directory, unreadable;  ResourceError  larger than memory
inline MappedFile map_file(const std::filesystem::path& path) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  };
  const auto in_memory = [&] {
    auto text = std::make_shared<const std::string>(read_file(path));
    return MappedFile{std::as_bytes(std::span(*text)), text};
  };
  const std::filesystem::path opened = opened_path(path);
  struct ::stat status {};
  if (::stat(opened.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return in_memory();  // a pipe is opened once
  const Descriptor file{::open(opened.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) throw_file_error(path, "read", errno);
  if (!S_ISREG(status.st_mode) || status.st_size == 0) return in_memory();
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number, 0);
  if (start == MAP_FAILED) throw_file_error(path, "map", errno);
  std::shared_ptr<const void> owner(start, [size](void* mapping) { ::munmap(mapping, size); });
  return {{static_cast<const std::byte*>(start), size}, std::move(owner)};
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// The path of an output that is named by a link: the end of the link, whether or not a file exists there.
#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "sublimit/base/detail/file_error.h"

namespace sublimit {

/// Returns the path that writing to `target` creates: links are followed to their end, as `cp` and the shell's `>` do.
/// @throws IoError  links in a circle, or a link that cannot be read
inline std::filesystem::path followed_links(const std::filesystem::path& target) {
  constexpr int most_links = 40;  // the limit of the kernel
  std::filesystem::path path = target;
  std::error_code failed;
  for (int links = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(path, failed)); ++links) {
    if (links == most_links) throw_file_error(target, "write", ELOOP);
    const std::filesystem::path next = std::filesystem::read_symlink(path, failed);
    if (failed) throw_file_error(target, "write", failed.value());
    path = path.parent_path() / next;  // `next` alone if it is absolute
  }
  return path;
}

/// Returns the directory of a file, "." if the path names none.
inline std::filesystem::path directory_of(const std::filesystem::path& path) {
  const std::filesystem::path directory = path.parent_path();
  return directory.empty() ? "." : directory;
}

}  // namespace sublimit

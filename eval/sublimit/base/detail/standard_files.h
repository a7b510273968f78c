// SPDX-License-Identifier: Apache-2.0
#pragma once
// Standard streams and other open descriptors as files of a format: "/dev/stdin.obj" is standard input as an OBJ. The
// system has no such files, so that no other file has such a name.
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sublimit {

/// An open descriptor that a path names, with the extension of a format behind it or without.
struct StandardFile {
  int descriptor;
  std::string device;     ///< "/dev/stdin", as the system names it
  std::string extension;  ///< ".obj"; empty if none is given
};

/// Returns the descriptor of "/dev/stdin", "/dev/stdout.ply", "/dev/fd/63.obj"; none for paths of other files.
inline std::optional<StandardFile> standard_file(const std::filesystem::path& path) {
  const std::string& name = path.native();
  const auto with = [&](int descriptor, std::size_t end) -> std::optional<StandardFile> {
    if (end < name.size() && (name[end] != '.' || name.find('/', end) != std::string::npos)) return std::nullopt;
    return StandardFile{descriptor, name.substr(0, end), name.substr(end)};
  };
  using namespace std::string_view_literals;
  for (const auto& [device, descriptor] : {std::pair{"/dev/stdin"sv, 0}, {"/dev/stdout"sv, 1}, {"/dev/stderr"sv, 2}})
    if (name.starts_with(device)) return with(descriptor, device.size());
  for (const std::string_view directory : {"/dev/fd/"sv, "/proc/self/fd/"sv}) {
    if (!name.starts_with(directory)) continue;
    int descriptor = -1;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + directory.size(), end, descriptor);
    if (read.ec == std::errc() && descriptor >= 0) return with(descriptor, std::size_t(read.ptr - name.data()));
  }
  return std::nullopt;
}

/// Returns the path that opens a file: "/dev/stdin" for "/dev/stdin.obj", any other path as it is.
inline std::filesystem::path opened_path(const std::filesystem::path& path) {
  const std::optional<StandardFile> stream = standard_file(path);
  return stream ? std::filesystem::path(stream->device) : path;
}

/// Returns the directory that names in a file are relative to: that of the file, or the working directory, "", if it is
/// a standard stream.
inline std::filesystem::path directory_of_names_in(const std::filesystem::path& path) {
  return standard_file(path) ? std::filesystem::path() : path.parent_path();
}

}  // namespace sublimit

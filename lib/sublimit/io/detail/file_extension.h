// SPDX-License-Identifier: Apache-2.0
#pragma once
// File types by extension.
#include <filesystem>
#include <string>

namespace sublimit {

/// Returns the extension of a path in lower case: ".obj" for MESH.OBJ, ".obj.gz" for mesh.obj.gz, empty if there is
/// none.
inline std::string file_extension(const std::filesystem::path& path) {
  const auto lower_case = [](std::string extension) {
    for (char& c : extension) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
  };
  const std::string extension = lower_case(path.extension().string());
  return extension.ends_with(".gz") ? lower_case(path.stem().extension().string()) + extension : extension;
}

}  // namespace sublimit

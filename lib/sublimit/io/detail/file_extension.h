// SPDX-License-Identifier: Apache-2.0
#pragma once
// File types by extension.
#include <filesystem>
#include <string>

namespace sublimit {

/// Returns the extension of a path in lower case: ".obj" for MESH.OBJ, empty if there is none.
inline std::string file_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace sublimit

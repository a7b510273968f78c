// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenSubdiv's regression shapes as OBJ files with tags, if they are beside the checkout. They are not part of
// the project.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "laws/full_sweep.h"

namespace sublimit::testing {

struct SharedMesh {
  std::filesystem::path path;
  std::string name;    ///< catmark_cube
  std::string scheme;  ///< scheme, by the prefix of the name
  friend std::ostream& operator<<(std::ostream& out, const SharedMesh& m) { return out << m.name; }
};

inline std::vector<SharedMesh> shared_meshes() {
  std::vector<SharedMesh> meshes;
  if (!std::filesystem::is_directory(SUBLIMIT_SHARED_MESHES)) return meshes;
  for (const auto& entry : std::filesystem::directory_iterator(SUBLIMIT_SHARED_MESHES)) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().stem().string(), prefix = name.substr(0, name.find('_'));
    meshes.push_back({entry.path(), name, prefix == "catmark" ? "catmull-clark" : prefix});
  }
  std::sort(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return meshes;
}

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Disjoint unions of all tagged meshes for a scheme with equal rules, to need fewer runs with many processes.
#include <map>
#include <tuple>
#include <vector>

#include "meshes/meshes.h"

namespace sublimit::testing {

inline std::vector<NamedMesh> tagged_unions() {
  std::map<std::tuple<std::string, std::optional<Boundary>, std::optional<Creasing>, std::optional<Triangles>>,
           NamedMesh>
      unions;
  for (const NamedMesh& tagged : tagged_meshes()) {
    const std::string scheme = tagged.schemes.front();
    const Mesh& mesh = tagged.mesh;
    const auto [at, is_new] = unions.try_emplace({scheme, mesh.boundary, mesh.creasing, mesh.triangles},
                                                 NamedMesh{tagged.name, {scheme}, mesh});
    if (is_new) continue;
    at->second.name += ", " + tagged.name;
    at->second.mesh = disjoint_union(at->second.mesh, mesh);
  }
  std::vector<NamedMesh> result;
  for (auto& [rules, mesh] : unions) result.push_back(std::move(mesh));
  return result;
}

}  // namespace sublimit::testing

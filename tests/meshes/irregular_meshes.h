// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes without symmetry, in which many valences and face sizes occur in all combinations.
#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "meshes/meshes.h"

namespace sublimit::testing {

Mesh bipyramid(Index n);  ///< triangles; two vertices of valence n, n of valence 4

/// Returns the mesh with `flips` random edges flipped, as far as valences stay from 3 to `most` and no edge is
/// doubled.
Mesh flipped(const Mesh& triangles, int flips, unsigned seed = 1, Index most = 10);

/// Returns the mesh with up to `edges` random edges removed and their faces joined, as far as valences stay at
/// least 3, faces get at most `most` corners, and the two faces have no further common vertex.
Mesh merged(const Mesh& mesh, int edges, unsigned seed = 1, Index most = 10);

/// Returns meshes for comparisons with other libraries: vertices are moved at random; valences (and face sizes
/// of polygon meshes) of 3 to 10 in all combinations, one valence of 60, regular regions. `schemes` is left
/// empty.
std::vector<NamedMesh> closed_triangle_meshes();
std::vector<NamedMesh> closed_polygon_meshes();  ///< triangles, quads, polygons
/// Returns such meshes with borders, some of them with vertices of a single face.
std::vector<NamedMesh> open_triangle_meshes();
std::vector<NamedMesh> open_polygon_meshes();

struct SchemeOnMesh {
  std::string scheme, name;
  Mesh mesh;
  friend std::ostream& operator<<(std::ostream& out, const SchemeOnMesh& s) {
    return out << s.scheme << " on " << s.name;
  }
};
/// Returns every combination of a scheme and a mesh.
std::vector<SchemeOnMesh> schemes_on(const std::vector<std::string>& schemes, const std::vector<NamedMesh>& meshes);
/// Returns the name of a parameterised test: modified_butterfly_torus.
inline constexpr auto name_of_test = [](const auto& tested) {
  std::string name = tested.param.scheme + "_" + tested.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Closed meshes without symmetry: all valences and face sizes, in all neighbourhoods.
#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "support/meshes.h"

namespace sublimit::testing {

Mesh bipyramid(Index n);  ///< triangles; two vertices of valence n, n of valence 4

/// Triangles, of which `flips` random edges have been flipped where valences stay from 3 to `most` and no edge is
/// doubled.
Mesh flipped(const Mesh& triangles, int flips, unsigned seed = 1, Index most = 10);

/// Up to `edges` random edges removed, their faces made one, where valences stay at least 3, faces get no more than
/// `most` corners, and no other vertex is common to both.
Mesh merged(const Mesh& mesh, int edges, unsigned seed = 1, Index most = 10);

/// What schemes are compared with other libraries on: every vertex moved at random, valences (and faces of polygon
/// meshes) of 3 to 10 in all combinations, one valence of 60, regular places too. The schemes' names are left empty.
std::vector<NamedMesh> closed_triangle_meshes();
std::vector<NamedMesh> closed_polygon_meshes();  ///< triangles, quads, polygons
/// With borders, some of them with vertices of a single face.
std::vector<NamedMesh> open_triangle_meshes();
std::vector<NamedMesh> open_polygon_meshes();

struct SchemeOnMesh {
  std::string scheme, name;
  Mesh mesh;
  friend std::ostream& operator<<(std::ostream& out, const SchemeOnMesh& s) {
    return out << s.scheme << " on " << s.name;
  }
};
/// Every one of the schemes on every one of the meshes.
std::vector<SchemeOnMesh> schemes_on(const std::vector<std::string>& schemes, const std::vector<NamedMesh>& meshes);
/// Of a parameterised test: modified_butterfly_torus.
inline constexpr auto name_of_test = [](const auto& tested) {
  std::string name = tested.param.scheme + "_" + tested.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};

}  // namespace sublimit::testing

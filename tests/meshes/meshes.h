// SPDX-License-Identifier: Apache-2.0
#pragma once
// Deterministic meshes for tests. Closed ones are oriented so that normals point outwards.
#include <ostream>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/detail/prepare.h"

namespace sublimit::testing {

Mesh make_mesh(const std::vector<Eigen::Vector3d>& positions, const std::vector<std::vector<Index>>& faces);

Mesh tetrahedron();
Mesh cube();  ///< [-1,1]^3; vertex i has the signs of the bits of i: x is bit 0, y bit 1, z bit 2
Mesh octahedron();
Mesh icosahedron();
/// Returns a torus of quads, m around the axis and n around the tube; vertex (i,j) has number i*n + j. m, n >=
/// 3.
Mesh torus(Index m, Index n);
Mesh triangle_torus(Index m, Index n);  ///< its quads cut along the same diagonal: valence 6 everywhere
/// Returns an open grid of m x n quads, wavy so that no face is plane; vertex (i,j) has number j*(m+1) + i.
Mesh grid(Index m, Index n);
Mesh triangle_grid(Index m, Index n);
/// Returns n faces of 3 or 4 corners around the interior vertex 0, with `rings` rings of faces in all. n >= 2
/// (triangles: 3, or 2 with one ring, which is a pillow). Spoke s ends at vertex 1 + 2s, and the far corner of
/// the quad to its left is 2 + 2s; triangles: spoke s ends at 1 + s.
Mesh fan(Index n, Index face_size = 4, Index rings = 1);
/// Returns such faces around the boundary vertex 0, n >= 1.
Mesh open_fan(Index n, Index face_size = 4, Index rings = 1);
/// Returns a closed mesh of two vertices of valence n, each in n triangles, with n quads between them. n >= 3.
Mesh pole(Index n);
Mesh prism(Index n);  ///< two n-gons, n quads
/// Returns an n-gon, n = sizes.size(), with a face of sizes[i] corners along each edge i. Faces of neighbouring
/// edges share an edge, so that the n inner vertices 0 .. n-1 have valence 3. The last size must not be 3.
Mesh polygon_ring(const std::vector<Index>& sizes);
Mesh mobius_strip(Index n);  ///< n quads; one edge between them is wound inconsistently

/// Returns the mesh with each coordinate moved by up to `amount`, depending on the seed, so that no symmetry
/// hides errors.
Mesh jittered(Mesh mesh, double amount = 0.1, unsigned seed = 1);

/// Returns the disjoint union of two meshes with their tags, and the options of `a`.
Mesh disjoint_union(const Mesh& a, const Mesh& b);
/// Returns the union in which vertex `b_vertices[i]` of b is identified with vertex `a_vertices[i]` of a.
Mesh glued(const Mesh& a, const Mesh& b, const std::vector<Index>& a_vertices, const std::vector<Index>& b_vertices);
/// Returns the mesh with every n-gon split into n quads at its centroid; from triangles, half of the vertices
/// become extraordinary. Edge midpoints are numbered by first appearance. Creases and holes are kept.
Mesh quads_from_triangles(const Mesh& mesh);

/// Adds a crease along a path of vertices, with one sharpness for all edges or one per edge.
void add_crease(Mesh& mesh, const std::vector<Index>& path, float sharpness);
void add_crease(Mesh& mesh, const std::vector<Index>& path, const std::vector<float>& sharpness);

struct NamedMesh {
  std::string name;
  std::vector<std::string> schemes;  ///< schemes that it is for: "catmull-clark", "loop", "bilinear"
  Mesh mesh;
  friend std::ostream& operator<<(std::ostream& out, const NamedMesh& m) { return out << m.name; }
};
/// Returns small meshes that together reach every rule of OpenSubdiv's Sdc and every kind of non-manifold
/// place.
std::vector<NamedMesh> tagged_meshes();

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles whose vertices know normals: what patches through points and normals (nielson.h, piper.h) start from.
#include <array>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/mesh_view.h"

namespace sublimit {

struct [[nodiscard]] NormalMesh {
  std::vector<Index> triangles;  ///< vertices, three a triangle, counter-clockwise
  Points positions;              ///< #V x 3
  Points normals;                ///< #V x 3, any length > 0; no rows: not known

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(triangles.size() / 3); }
  /// Points or normals of the corners of a triangle.
  std::array<Eigen::Vector3d, 3> corners(const Points& rows, Index face) const {
    const Index* v = triangles.data() + 3 * std::ptrdiff_t{face};
    return {rows.row(v[0]), rows.row(v[1]), rows.row(v[2])};
  }
};
using GeometricNormalScheme = GeometricScheme<NormalMesh>;

inline MeshView view(const NormalMesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.triangles, .face_sizes = {}, .face_size = 3};
}

/// The mesh with a normal for each vertex.
/// @param normals  #V x 3, or no rows
/// @throws InvalidMesh          another number of normals; a face that is a hole
/// @throws UnsupportedTopology  a face that is not a triangle, naming the first
NormalMesh normal_mesh(const Mesh& mesh, const Points& normals);

/// Returns the mesh with normals of length 1; those that have it keep their bits. Any topology will do; vertices
/// without a face are not looked at.
/// @throws InvalidMesh  indices out of range; no faces; no normals; at a vertex, naming it: numbers that are not
/// finite,
///     a normal of length 0; on an edge, naming it: ends that coincide or are too far apart, a normal along it (up to
///     1e-12), normals of its ends that are opposite (up to 1e-9)
NormalMesh checked(NormalMesh mesh);

/// Mean normals of the triangles around each vertex, weighted by their angles there, of length 1; zero where there are
/// none or they cancel.
/// @throws InvalidMesh  no faces, indices out of range, positions that are not finite
/// Source: Thuermer, Wuethrich, "Computing vertex normals from polygonal facets", J. Graphics Tools 3(1), 1998.
Points estimated_normals(const NormalMesh& mesh);

/// Triangles that are wound against the normals of their corners, of most of them at least.
std::vector<bool> wound_against_normals(const NormalMesh& checked);

}  // namespace sublimit

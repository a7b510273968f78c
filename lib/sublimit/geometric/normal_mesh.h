// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangle meshes with normals at the vertices: input of patches through points and normals (nielson.h,
// piper.h).
#include <array>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/mesh_view.h"

namespace sublimit {

/// A mesh with normals.
struct [[nodiscard]] NormalMesh {
  std::vector<Index> triangles;  ///< three vertices per triangle, counter-clockwise
  Points positions;              ///< #V x 3
  Points normals;                ///< #V x 3, any length > 0; no rows: unknown

  Index num_vertices() const { return static_cast<Index>(positions.rows()); }
  Index num_faces() const { return static_cast<Index>(triangles.size() / 3); }
  /// Returns the rows of `positions` or `normals` at the corners of a triangle.
  std::array<Eigen::Vector3d, 3> corners(const Points& rows, Index face) const {
    const Index* v = triangles.data() + 3 * std::ptrdiff_t{face};
    return {rows.row(v[0]), rows.row(v[1]), rows.row(v[2])};
  }
};
using GeometricNormalScheme = GeometricScheme<NormalMesh>;

/// Returns the faces as a view.
inline MeshView view(const NormalMesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.triangles, .face_sizes = {}, .face_size = 3};
}

/// Returns a mesh with a normal at each vertex.
/// @param normals  #V x 3, or no rows
/// @throws InvalidMesh          another number of normals; a face that is a hole
/// @throws UnsupportedTopology  a face that is not a triangle; names the first
NormalMesh normal_mesh(const Mesh& mesh, const Points& normals);

/// Returns the mesh with unit normals; unit normals keep their bits. Any topology is allowed; vertices without
/// a face are not checked.
/// @throws InvalidMesh  indices out of range; no faces; no normals; numbers that are not finite or a normal of
///                      length 0, naming the vertex; ends of an edge that coincide or are too far apart, a
///                      normal along the edge (up to 1e-12), opposite normals at its ends (up to 1e-9), naming
///                      the edge
NormalMesh checked(NormalMesh mesh);

/// Returns unit mean normals of the triangles around each vertex, weighted by their angles there; zero if there
/// are none or they cancel.
/// @throws InvalidMesh  no faces, indices out of range, positions that are not finite
/// Source: Thuermer, Wuethrich, "Computing vertex normals from polygonal facets", J. Graphics Tools 3(1), 1998.
Points estimated_normals(const NormalMesh& mesh);

/// Returns for each triangle whether it is wound against the normals of most of its corners.
std::vector<bool> wound_against_normals(const NormalMesh& checked);

}  // namespace sublimit

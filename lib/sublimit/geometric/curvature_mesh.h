// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles whose vertices know normal, principal curvatures and directions: what surfaces through such data start
// from.
#include <span>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/geometric/surface_point.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/mesh_view.h"
#include "sublimit/mesh/vertex_target.h"

namespace sublimit {

struct [[nodiscard]] CurvatureMesh {
  std::vector<Index> triangles;      ///< vertices, three a triangle, counter-clockwise
  std::vector<SurfacePoint> points;  ///< a vertex each
  std::vector<bool> original = {};   ///< per vertex, whether it was given; empty: all

  Index num_vertices() const { return static_cast<Index>(points.size()); }
  Index num_faces() const { return static_cast<Index>(triangles.size() / 3); }
};

inline MeshView view(const CurvatureMesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.triangles, .face_sizes = {}, .face_size = 3};
}

/// How far a direction may be from the tangent plane, in radians, and a length from 1; it is then made exact.
inline constexpr double direction_tolerance = 1e-6, unit_tolerance = 1e-6;

/// The mesh with a target at each vertex. Positions are those of the targets. Quads are cut along the shorter diagonal
/// of the targets' positions, between corners 0 and 2 where both are equally long.
/// @throws InvalidMesh  a vertex without a target or with several, a target of no vertex; a target without normal or
///     curvature; numbers that are not finite; a normal or direction of length zero; a direction that is not in the
///     tangent plane (the message tells the angle); what `checked` refuses
/// @throws UnsupportedTopology  a face of more than four corners
CurvatureMesh curvature_mesh(const Mesh& mesh, std::span<const VertexTarget> targets);

/// Returns the mesh with normals and directions of length 1 and at right angles; those that are so keep their bits.
/// @throws InvalidMesh  data that are not finite, of other lengths, or not tangent, naming the vertex
/// @throws UnsupportedTopology  edges or vertices that are not manifold, vertices without a face, naming them
CurvatureMesh checked(CurvatureMesh mesh);

/// Positions and triangles alone, to be written.
Mesh control_mesh(const CurvatureMesh& mesh);

}  // namespace sublimit

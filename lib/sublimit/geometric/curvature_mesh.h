// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangle meshes with normal, principal curvatures and principal directions at each vertex: input of surfaces
// through such data.
#include <span>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/geometric/surface_point.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/mesh_view.h"
#include "sublimit/mesh/vertex_target.h"

namespace sublimit {

/// A mesh with data of second order.
struct [[nodiscard]] CurvatureMesh {
  std::vector<Index> triangles;      ///< three vertices per triangle, counter-clockwise
  std::vector<SurfacePoint> points;  ///< data of each vertex
  std::vector<bool> original = {};   ///< per vertex: true if it was given, not computed; empty: all

  Index num_vertices() const { return static_cast<Index>(points.size()); }
  Index num_faces() const { return static_cast<Index>(triangles.size() / 3); }
};

/// Returns the faces as a view.
inline MeshView view(const CurvatureMesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.triangles, .face_sizes = {}, .face_size = 3};
}

/// Tolerances of `checked`: angle of a direction to the tangent plane, in radians, and deviation of a length
/// from 1. Data within them are corrected.
inline constexpr double direction_tolerance = 1e-6, unit_tolerance = 1e-6;

/// Returns a mesh with the data of targets, one at each vertex. Positions are those of the targets.
/// Quadrilaterals are cut along the shorter diagonal, or between corners 0 and 2 if both are equally long.
/// @throws InvalidMesh  a vertex without a target or with several, a target of no vertex; a target without normal or
///     curvature; numbers that are not finite; a normal or direction of length zero; a direction that is not in the
///     tangent plane (the message has the angle); see also `checked`
/// @throws UnsupportedTopology  a face of more than four corners
CurvatureMesh curvature_mesh(const Mesh& mesh, std::span<const VertexTarget> targets);

/// Returns the mesh with orthonormal normals and directions; those that are orthonormal already keep their
/// bits.
/// @throws InvalidMesh  data that are not finite, of other lengths, or not tangent, naming the vertex
/// @throws UnsupportedTopology  edges or vertices that are not manifold, vertices without a face, naming them
CurvatureMesh checked(CurvatureMesh mesh);

/// Returns positions and triangles as a mesh, for writing.
Mesh control_mesh(const CurvatureMesh& mesh);

}  // namespace sublimit

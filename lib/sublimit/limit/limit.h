// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit positions, normals and tangents of the vertices of a mesh, in one call:
//
//   const Limit limit = sublimit::limit(read_mesh("torus.obj"), "loop");
//   limit.points.row(7), limit.normals.row(limit.corner_side[0]);
#include <memory>
#include <vector>

#include "sublimit/scheme/any_scheme.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

class LimitCache;

/// Limit positions of all vertices of a level, and normals of their sides: a vertex has one side, unless sharp edges,
/// or sheets that meet there, separate its faces. Plain data.
struct [[nodiscard]] Limit {
  Points points;                    ///< #V x 3
  Points normals;                   ///< #sides x 3, unit length, by the winding of faces; zero where there is none
  Points tangent1, tangent2;        ///< #sides x 3, not unit: their cross product is along the normal
  std::vector<LimitStatus> status;  ///< of each side
  std::vector<Index> side_vertex;   ///< vertex of each side, ascending
  std::vector<Index> corner_side;   ///< side of each corner of each face, face after face
  std::vector<Index> face_sizes, face_vertices;   ///< of the level
  SparseMatrix matrix;                            ///< #V x #control points: points = matrix * control points
  SparseMatrix tangent1_matrix, tangent2_matrix;  ///< #sides x #control points
};

/// Returns an empty cache of a scheme's limits by type of neighbourhood, which `limit` and surfaces of this scheme fill
/// and use. Any number of meshes, surfaces and threads may share one; its size depends on the number of types, not of
/// vertices. For meshes with a rule for triangles (`Mesh::triangles`) give it `scheme.for_mesh(mesh)`.
std::shared_ptr<LimitCache> limit_cache(const AnyScheme& scheme);

/// Options of `limit`.
struct LimitOptions {
  int levels = 0;  ///< level whose vertices get limits; 0: the mesh itself
  /// Cache shared between calls with the same scheme, if given, so that each type of neighbourhood is computed once;
  /// `limit_cache` makes one.
  std::shared_ptr<LimitCache> cache = nullptr;
};

/// Returns the limits of the vertices of a mesh, or of one of its refinements.
/// @throws InvalidParameter                  a negative level; a cache of another scheme
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine, coordinates that are not finite:
///                                           says where
/// @throws NoLimit                           a vertex where the scheme does not converge: says which
/// @throws ResourceError                     more memory than there is
Limit limit(const Mesh& mesh, const AnyScheme& scheme, const LimitOptions& options = {});

}  // namespace sublimit

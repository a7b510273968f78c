// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of the vertices of a mesh, in one call:
//
//   const Limit limit = sublimit::limit(read_mesh("torus.obj"), "loop");
//   limit.points.row(7), limit.normals.row(limit.corner_side[0])
#include <memory>
#include <vector>

#include "sublimit/limit/limit_status.h"
#include "sublimit/scheme/any_scheme.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

class LimitTypes;

/// Limit positions of all vertices of a level, and normals of their sides: a vertex has one side, unless sharp edges,
/// or sheets that meet there, cut its faces apart.
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

struct LimitOptions {
  int level = 0;  ///< whose vertices: 0 of the mesh itself
  /// Shared between calls with the same scheme, if given: types of neighbourhoods are found once. Made by
  /// `std::make_shared<LimitTypes>(*scheme)` (limit/limit_types.h).
  std::shared_ptr<LimitTypes> cache = nullptr;
};

/// Returns the limits of the vertices of a mesh, or of one of its refinements.
/// @throws InvalidParameter                  a negative level; a cache of another scheme
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine, coordinates that are not finite:
/// says
///                                           where
/// @throws NoLimit                           a vertex where the scheme does not converge: says which
/// @throws ResourceError                     more memory than there is
Limit limit(const ControlMesh& mesh, const AnyScheme& scheme, const LimitOptions& options = {});

}  // namespace sublimit

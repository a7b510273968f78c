// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points and normals with dual schemes, without a system to solve. A dual scheme makes a face of every vertex, and
// these faces have no point in common; the limit of the vertex and its tangents depend on the points of its face alone
// (of a face inside, the limit is the centroid). So each datum (P, N) gets its own plane polygon: through P, across N.
// All that follows of a plane face stays in its plane.
//
// The polygons are those of the given mesh, refined until its vertices are faces, turned and moved as they are.
// Doo-Sabin's weights and mid-edge's alike; a vertex on the border has its limit in the middle of a border edge of its
// face. Source: Doo, Sabin 1978; Nasri 1987, "Polyhedral subdivision methods for free-form surfaces".
#include "sublimit/fit/targets.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

struct PolygonOptions {
  /// Size of the polygon at each point, as a fraction of the edge length on a regular grid; in (0, 1). 1/2 is how the
  /// scheme refines, less is flatter around the points and bends more between them.
  double size = 0.5;
  SubdivisionOptions rules = {};
};

/// A control mesh with a face for every vertex of the given one.
struct [[nodiscard]] PointNormalMesh {
  Level level;                        ///< 1, of mid-edge schemes 2
  Points points;                      ///< its control points, #V x 3
  std::vector<Index> faces;           ///< by target: the face that carries it (the first one's of several sheets)
  Eigen::VectorXd position_residual;  ///< by target: distance of the limit from it
  Eigen::VectorXd normal_residual;    ///< radians; NaN without a normal
  /// Vertices whose normal opposes the winding of the refined mesh: met too, but the surface folds around them.
  std::vector<Index> folded;
};

/// The limit of `level` with `points` passes through the targets with their normals.
///
/// A target without a normal moves its polygon and does not turn it; the polygon of a vertex without a target stays
/// where refinement puts it, after vertices with targets have been moved by what their limits lack.
/// @param mesh  any topology, closed or with borders; its positions are the first guess
/// @throws InvalidParameter     a scheme whose vertices do not become faces; a vertex that does not exist, is isolated
///     or has two targets; a normal of zero length, curvature, numbers that are not finite; another size
/// @throws InvalidMesh          a vertex whose faces have no extent; and as refinement does
/// @throws UnsupportedTopology  a vertex whose limit depends on points beyond its own face: of averaging with degrees
///                              beyond 2; a vertex between two faces only; a normal where the limit has no tangent
///                              plane: on borders under mid-edge schemes
PointNormalMesh point_normal_mesh(const Scheme<double>& scheme, const Mesh& mesh,
                                  const std::vector<VertexTarget>& targets, const PolygonOptions& options = {});

}  // namespace sublimit

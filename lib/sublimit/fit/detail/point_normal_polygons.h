// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interpolation of points and normals with dual schemes, without a linear system. Dual schemes turn every
// vertex into a face; these faces have no common points, and the limit of the vertex and its tangents depend
// only on the points of its face (for an interior face the limit is the centroid). Each datum (P, N) therefore
// gets its own planar polygon through P with normal N, and all descendants of a planar face stay in its plane.
//
// The polygons are those of the given mesh, refined until its vertices are faces, then rotated and translated.
// This holds for Doo-Sabin and mid-edge schemes. The limit of a border vertex is the middle of a border edge of
// its face. Source: Doo, Sabin 1978; Nasri 1987, "Polyhedral subdivision methods for free-form surfaces".
#include "sublimit/fit/targets.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Options of `point_normal_mesh`.
struct PolygonOptions {
  /// Size of the polygon at each point, as a fraction of the edge length on a regular grid; in (0, 1). 1/2 is
  /// the size of refined meshes; smaller values make the surface flatter around the points and more curved
  /// between them.
  double size = 0.5;
  SubdivisionOptions rules = {};
};

/// A control mesh with a face for every vertex of the given one.
struct [[nodiscard]] PointNormalMesh {
  Level level;                        ///< level 1; for mid-edge schemes level 2
  Points points;                      ///< its control points, #V x 3
  std::vector<Index> faces;           ///< by target: the face that interpolates it (for several sheets, the first one)
  Eigen::VectorXd position_residual;  ///< by target: distance of the limit from it
  Eigen::VectorXd normal_residual;    ///< radians; NaN without a normal
  /// Vertices whose normal is opposite to the winding of the refined mesh. It is interpolated, but the surface
  /// folds there.
  std::vector<Index> folded;
};

/// Returns a control mesh whose limit interpolates the targets with their normals.
///
/// A target without a normal translates its polygon without rotation. The polygon of a vertex without a target
/// is that of refinement, after vertices with targets have been corrected by the distance of their limits from
/// the targets.
/// @param mesh  any topology, closed or with borders; its positions are the first guess
/// @throws InvalidParameter     a scheme whose vertices do not become faces; a vertex that does not exist, is isolated
///     or has two targets; a normal of zero length, curvature, numbers that are not finite; another size
/// @throws InvalidMesh          a vertex whose faces have no extent; see also refinement
/// @throws UnsupportedTopology  a vertex whose limit depends on points outside its face (averaging of degree
///                              above 2); a vertex between two faces only; a normal where the limit has no
///                              tangent plane: on borders under mid-edge schemes
PointNormalMesh point_normal_mesh(const Scheme<double>& scheme, const Mesh& mesh,
                                  const std::vector<VertexTarget>& targets, const PolygonOptions& options = {});

}  // namespace sublimit

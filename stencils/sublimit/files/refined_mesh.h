// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels on their way to a file: refined meshes with the tags that are left, limit meshes with normals.
#include "sublimit/io/write_mesh.h"
#include "sublimit/limit/limit_points.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// A level as a mesh. With `tags`, refining what is read back goes on where this level stopped: sharpness and holes are
/// written where connectivity does not imply them, and Boundary::none becomes edge-only with the holes that it made.
/// @note  The middle of a non-manifold edge of two faces wound alike is a crease here and a corner to a reader, which
/// cannot
///        know better. Nor can it tell apart two edges that join the same two vertices: children of such meshes (a
///        pillow of two triangles, a degenerate edge) are joined otherwise when read back.
MeshOutput refined_mesh(const Level& level, const Points& points, const ControlMesh& control,
                        const SubdivisionOptions& options, bool tags);

/// Sharp edges and vertices of a level that its connectivity and the rule for borders do not imply.
struct RemainingTags {
  std::vector<Edge> creases;
  std::vector<Vertex> corners;
  Boundary boundary = Boundary::edge_only;  ///< never none: what that made are holes
};
RemainingTags remaining_tags(const Level& level, const ControlMesh& control, const SubdivisionOptions& options);

/// Limit positions, without the faces that are holes. Normals, if wanted, are per corner (each side of a crease has its
/// own), or the mean of a vertex's sides where the format has one per vertex.
enum class Normals { none, per_corner, per_vertex };
MeshOutput limit_mesh(const Level& level, const LimitMatrices& limit, const LimitPoints& points, Normals normals);

/// Gives an output of the same level the values of a channel. Refining what is read back goes on where this level
/// stopped, by the tag `facevaryinginterpolateboundary`, which the caller sets.
/// @param values  of the level's topology, a row each; corners of faces that the output leaves out, being holes, are
/// left out
void add_channel(MeshOutput& out, const FaceVaryingLevel& channel, const std::string& name, const Points& values);

}  // namespace sublimit

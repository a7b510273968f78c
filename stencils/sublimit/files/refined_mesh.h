// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels on their way to a file: refined meshes with the tags that are left, limit meshes with normals.
#include "sublimit/io/write_mesh.h"
#include "sublimit/limit/limit_points.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refined_mesh.h"

namespace sublimit {

/// A level as a mesh (`level_mesh`), or its points and faces alone.
MeshOutput level_output(const Level& level, const Points& points, const ControlMesh& control,
                        const SubdivisionOptions& options, bool tags);
/// The same of a mesh that is one already.
MeshOutput mesh_output(ControlMesh mesh, bool tags);

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

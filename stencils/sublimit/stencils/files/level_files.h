// SPDX-License-Identifier: Apache-2.0
#pragma once
// Output meshes for levels: refined meshes with remaining tags, limit meshes with normals.
#include "sublimit/io/write_mesh.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refined_mesh.h"

namespace sublimit {

/// Returns a level as a mesh (`level_mesh`), or only its points and faces.
Mesh level_output(const Level& level, const Points& points, const Mesh& control, const SubdivisionOptions& options,
                  bool tags);
/// Returns a mesh of points, faces, values and names only.
Mesh without_tags(Mesh mesh);

/// Returns the mesh of limit positions, without holes. Normals, if wanted, are per corner (each side of a crease has
/// its own), or the mean over a vertex's sides if the format has one per vertex.
enum class Normals { none, per_corner, per_vertex };
Mesh limit_mesh(const Level& level, const LimitMatrices& limit, const LimitPoints& points, Normals normals);

/// Adds the values of a channel to an output of the same level. Refining the file that is read back continues the
/// refinement, by the tag `facevaryinginterpolateboundary`, which the caller sets.
/// @param values  values of the level, one in each row; corners of holes that the output leaves out are skipped
void add_channel(Mesh& out, const FaceVaryingLevel& channel, const std::string& name, const Points& values);

}  // namespace sublimit

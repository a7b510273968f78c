// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels of a job as meshes, with their texture coordinates.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit {

/// True if a channel that the scheme cannot refine may be left out: refining it was not asked for.
/// @param error  thrown when it was refined
bool may_leave_out(const MeshJob& job, const Error& error);
/// Returns the warning that a channel is left out.
/// @param number   number of the channel; 0: texture coordinates
/// @param why_not  the reason
std::string left_out(const Mesh::FaceVarying& channel, size_t number, const std::string& why_not);

/// Returns the levels of one of the mesh's channels, its texture coordinates by default; empty if it has none, or if
/// the scheme cannot refine them and they were not asked for.
/// @param why_not  set to the reason if the scheme cannot refine them
/// @throws Error   the scheme cannot refine them, and they were asked for
std::vector<FaceVaryingLevel> refined_channel(const MeshJob& job, const std::vector<Level>& levels,
                                              std::string& why_not, size_t number = 0);

/// Gives a mesh of the last level's faces, or of those that are no holes, what the mesh of a job carries.
/// @param limit  weights that take values of the level to the limit; null: values are those of the level
void carry_attributes(const MeshJob& job, const std::vector<Level>& levels, Mesh& out,
                      const SparseMatrix* limit = nullptr);
/// True if a mesh has values at vertices, or names or values of faces, that are to be carried on.
bool carries_attributes(const Mesh& mesh);
/// True if it has names or values of faces.
bool carries_face_attributes(const Mesh& mesh);

/// Returns level `levels` with remaining tags and attributes, without channels.
/// @throws Error    as `refined_mesh`
Mesh refined_positions(const MeshJob& job, int levels, const std::function<void(int)>& progress);

/// Returns level `levels` with remaining tags (`level_mesh`) and all channels.
/// @param progress  called before each level with its number, if given
/// @throws Error    as `refined_mesh`, `refined_channel`
/// @note  The result has only new warnings, not those of the mesh.
Mesh refined_mesh(const MeshJob& job, int levels, const std::function<void(int)>& progress = {});

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels of a job as meshes, with their texture coordinates.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/jobs/mesh_job.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/scheme/refined_mesh.h"

namespace sublimit {

/// Levels of the mesh's texture coordinates; none if it has none.
/// @param why_not  why the scheme cannot refine them, if they were not asked for: they are left out
/// @throws Error   the same reason, if they were asked for
std::vector<FaceVaryingLevel> refined_channel(const MeshJob& job, const std::vector<Level>& levels,
                                              std::string& why_not);

/// Level `levels` with the tags that are left (`level_mesh`) and its texture coordinates.
/// @param progress  called before each level with its number, if given
/// @throws Error    as `refined_mesh`, `refined_channel`
/// @note  The warnings of the result are what is new in it.
ControlMesh refined_mesh(const MeshJob& job, int levels, const std::function<void(int)>& progress = {});

/// Points, faces and values alone.
ControlMesh without_tags(ControlMesh mesh);

}  // namespace sublimit

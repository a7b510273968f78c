// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles near the limit of a job's mesh, with its channels.
#include "sublimit/stencils/jobs/detail/mesh_job.h"
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Returns triangles near the limit, with `face_ids`, the channels of the mesh and, if `options.normals`, normals.
/// `warnings` of the result says why channels that the scheme cannot refine are left out.
/// @throws UnsupportedTopology, InvalidOption  such a channel, if `job.face_varying_asked`
/// @throws as `LimitSurface` and `tessellate` of a surface
Mesh tessellated_mesh(const MeshJob& job, const TessellationOptions& options);

}  // namespace sublimit

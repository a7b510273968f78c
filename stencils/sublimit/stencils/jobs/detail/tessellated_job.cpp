// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/jobs/detail/tessellated_job.h"

#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/stencils/files/tessellation_mesh.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

Mesh tessellated_mesh(const MeshJob& job, const TessellationOptions& options) {
  const LimitSurface surface(job.mesh, *job.scheme);
  Tessellation made = tessellate(surface, options);
  Mesh triangles = tessellation_mesh(made, surface.map().addresses());
  if (options.normals) add_normals(triangles, made, std::move(made.normals), false);
  carry_attributes(*job.scheme, job.mesh, surface.map(), made, triangles);
  for (size_t c = 0; c < job.mesh.face_varying.size(); ++c) {
    const Mesh::FaceVarying& channel = job.mesh.face_varying[c];
    try {
      add_channel(triangles, made, *job.scheme, job.face_varying, channel, surface.map().level());
    } catch (const Error& error) {
      if (!may_leave_out(job, error)) throw;
      triangles.warnings.push_back(left_out(channel, c, error.what()));
    }
  }
  return triangles;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/jobs/detail/refined_job.h"

#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/primvar/vertex_values.h"

namespace sublimit {

bool may_leave_out(const MeshJob& job, const Error& error) {
  const bool unable = error.code() == ErrorCode::unsupported_topology || error.code() == ErrorCode::invalid_option;
  return unable && !job.face_varying_asked;
}

std::string left_out(const Mesh::FaceVarying& channel, size_t number, const std::string& why_not) {
  return (number == 0 ? std::string("texture coordinates are") : "channel '" + channel.name + "' is") +
         " left out: " + why_not;
}

std::vector<FaceVaryingLevel> refined_channel(const MeshJob& job, const std::vector<Level>& levels,
                                              std::string& why_not, size_t number) {
  if (number >= job.mesh.face_varying.size()) return {};
  try {
    return refine_face_varying(*job.scheme, job.face_varying, job.mesh.face_varying[number], levels);
  } catch (const Error& error) {
    if (!may_leave_out(job, error)) throw;
    why_not = error.what();
    return {};
  }
}

void carry_attributes(const MeshJob& job, const std::vector<Level>& levels, Mesh& out, const SparseMatrix* limit) {
  Points values = refined_vertex_values(*job.scheme, job.mesh, levels);
  // Linear values are their own limits.
  if (limit && job.mesh.attributes != Attributes::linear && values.cols() > 0) values = apply(*limit, values);
  carry_attributes(job.mesh, levels, values, out);
}

bool carries_face_attributes(const Mesh& mesh) { return has_face_attributes(mesh); }

bool carries_attributes(const Mesh& mesh) {
  return has_face_attributes(mesh) || (!mesh.vertex_values.empty() && mesh.attributes != Attributes::drop);
}

Mesh refined_positions(const MeshJob& job, int levels, const std::function<void(int)>& progress) {
  Mesh refined = refined_mesh(*job.scheme, job.mesh, levels, job.rules, progress);
  if (job.mesh.attributes == Attributes::linear)
    set_vertex_values(refined, job.mesh, refined_vertex_values(*job.scheme, job.mesh, levels));
  return refined;
}

Mesh refined_mesh(const MeshJob& job, int levels, const std::function<void(int)>& progress) {
  if (job.mesh.face_varying.empty()) return refined_positions(job, levels, progress);
  const std::vector<Level> all = refine(*job.scheme, job.mesh, levels, job.rules, progress);
  Points points = job.mesh.positions;
  for (size_t k = 1; k < all.size(); ++k) points = apply(all[k].S, points);
  Mesh refined = level_mesh(all.back(), std::move(points), job.mesh, job.rules);
  carry_attributes(job, all, refined);
  for (const Topology::Fault& fault : all[0].topology().faults()) refined.warnings.push_back(fault.message);
  for (size_t c = 0; c < job.mesh.face_varying.size(); ++c) {
    const Mesh::FaceVarying& given = job.mesh.face_varying[c];
    std::string why_not;
    const std::vector<FaceVaryingLevel> channel = refined_channel(job, all, why_not, c);
    if (channel.empty()) {
      refined.warnings.push_back(left_out(given, c, why_not));
      continue;
    }
    const Topology& t = channel.back().level.topology();
    Mesh::FaceVarying values{given.name, refined_values(channel, given.values), {}};
    for (Index f = 0; f < t.num_faces(); ++f) {
      const auto corners = t.vertices(Face{f});
      values.indices.insert(values.indices.end(), corners.begin(), corners.end());
    }
    refined.face_varying.push_back(std::move(values));
  }
  if (!refined.face_varying.empty()) refined.face_varying_interpolation = job.face_varying;
  return refined;
}

}  // namespace sublimit

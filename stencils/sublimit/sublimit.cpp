// SPDX-License-Identifier: Apache-2.0
#include "sublimit/sublimit.h"

#include <string>
#include <utility>

#include "sublimit/fit/detail/interpolate.h"
#include "sublimit/primvar/vertex_values.h"
#include "sublimit/mesh/detail/points_in_space.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"
#include "sublimit/stencils/jobs/detail/refined_job.h"
#include "sublimit/stencils/jobs/detail/tessellated_job.h"

namespace sublimit {
namespace {

/// @throws InvalidMesh  names of some faces, which no result would have
MeshJob job_of(const Mesh& mesh, const AnyScheme& scheme) {
  check_attributes(mesh);
  MeshJob job;
  job.mesh = mesh;
  job.scheme = *scheme.for_mesh(mesh);
  job.options = job.scheme->chosen;
  job.face_varying = mesh.face_varying_interpolation.value_or(job.face_varying);
  return job;
}

/// @throws InvalidParameter  none or several of the choices
BakeRequest request_of(const BakeOptions& options) {
  const int choices = int(options.levels.has_value()) + int(options.grid.has_value()) + int(!options.at.empty());
  if (choices != 1)
    throw InvalidParameter("a table is of one of levels, grid and at; " + std::to_string(choices) +
                           " of them are given");
  if (options.limit && !options.levels)
    throw InvalidParameter("limit is of levels; grid and at are of the limit anyway");
  BakeRequest request;
  request.rows = options.grid          ? TableRows::grid
                 : !options.at.empty() ? TableRows::samples
                 : options.limit       ? TableRows::limit
                                       : TableRows::level;
  request.level = options.levels.value_or(0);
  request.grid = options.grid.value_or(0);
  request.samples = options.at;
  request.face_sizes = options.face_sizes;
  request.face_vertices = options.face_vertices;
  request.derivatives = options.derivatives;
  request.order = options.order;
  return request;
}

}  // namespace

Mesh refine(const Mesh& mesh, const AnyScheme& scheme, int levels, const std::function<void(int)>& progress) {
  MeshJob job = job_of(mesh, scheme);
  job.mesh.positions = points_in_space(mesh);
  return refined_mesh(job, levels, progress);
}

std::vector<Level> levels(const Mesh& mesh, const AnyScheme& scheme, int levels) {
  return refine(*scheme.for_mesh(mesh), mesh, levels);
}

SparseMatrix subdivision_matrix(const Mesh& mesh, const AnyScheme& scheme, int levels) {
  return refinement_matrix(sublimit::levels(mesh, scheme, levels));
}

MeshInfo info(const Mesh& mesh) {
  MeshJob job;
  job.mesh = mesh;
  return mesh_info(job);
}
MeshInfo info(const Mesh& mesh, const AnyScheme& scheme, const InfoOptions& options) {
  const MeshJob job = job_of(mesh, scheme);
  MeshInfo known = mesh_info(job);
  if (options.limit) known.limit = limit_integrals(job);
  return known;
}

Table bake(const Mesh& mesh, const AnyScheme& scheme, const BakeOptions& options) {
  const BakeRequest request = request_of(options);
  Patterns patterns(*scheme.for_mesh(mesh));
  Baked baked = bake(patterns, mesh, request);
  if (options.in_double) return Table(AnyTable(std::move(baked.table)));
  return Table(AnyTable(in_float(baked.table)));
}

Table bake(const Patches& patches, const BakeOptions& options) {
  Baked baked = bake(patches.set(), request_of(options));
  if (options.in_double) return Table(AnyTable(std::move(baked.table)));
  return Table(AnyTable(in_float(baked.table)));
}

Mesh tessellate(const Mesh& mesh, const AnyScheme& scheme, const TessellationOptions& options) {
  return tessellated_mesh(job_of(mesh, scheme), options);
}

Fit fit(const Mesh& mesh, const AnyScheme& scheme, const std::vector<VertexTarget>& targets,
        const FitOptions& options) {
  for (const VertexTarget& target : targets)
    if (target.curvature)
      throw InvalidParameter("vertex " + std::to_string(target.vertex) +
                             ": a target has a curvature, which limits of schemes are not fitted to; leave it out");
  Interpolation found = interpolate(*scheme.for_mesh(mesh), mesh, targets,
                                    {.least_refinements = options.least_refinements,
                                     .most_refinements = options.most_refinements,
                                     .fairness = options.fairness,
                                     .conditioning = false});
  if (targets.empty()) throw InvalidParameter("no targets; one is needed at least");  // faults of the mesh come first
  Fit result;
  result.solved = found.solved();
  if (!result.solved) result.why_not = why_unsolved(found.attempts.back());
  result.refinements = found.attempts.back().refinements;
  result.position_error = std::move(found.position_error);
  result.normal_error = std::move(found.normal_error);
  result.mesh = level_mesh(found.level, std::move(found.points), mesh);
  if (carries_attributes(mesh))
    carry_attributes(job_of(mesh, scheme), levels(mesh, scheme, result.refinements), result.mesh);
  return result;
}

}  // namespace sublimit

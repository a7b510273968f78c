// SPDX-License-Identifier: Apache-2.0
#include "sublimit/sublimit.h"

#include <string>
#include <utility>

#include "sublimit/bake/bake.h"
#include "sublimit/fit/interpolate.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/jobs/refined_job.h"
#include "sublimit/mesh/points_in_space.h"

namespace sublimit {
namespace {

MeshJob job_of(const Mesh& mesh, const AnyScheme& scheme) {
  MeshJob job;
  job.mesh = mesh;
  job.scheme = *scheme.for_mesh(mesh);
  job.options = job.scheme->chosen;
  job.face_varying = mesh.face_varying_interpolation.value_or(job.face_varying);
  return job;
}

/// @throws InvalidParameter  none or several of the choices
BakeRequest request_of(const BakeOptions& options) {
  const int choices = int(options.levels.has_value()) + int(options.grid.has_value()) + int(!options.places.empty());
  if (choices != 1)
    throw InvalidParameter("a table is of one of levels, grid and places; " + std::to_string(choices) +
                           " of them are given");
  if (options.limit && !options.levels)
    throw InvalidParameter("limit is of levels; grids and places are of the limit anyway");
  BakeRequest request;
  request.rows = options.grid              ? TableRows::grid
                 : !options.places.empty() ? TableRows::samples
                 : options.limit           ? TableRows::limit
                                           : TableRows::level;
  request.level = options.levels.value_or(0);
  request.grid = options.grid.value_or(0);
  request.samples = options.places;
  request.face_sizes = options.face_sizes;
  request.face_vertices = options.face_vertices;
  request.derivatives = options.derivatives;
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
MeshInfo info(const Mesh& mesh, const AnyScheme& scheme) { return mesh_info(job_of(mesh, scheme)); }

Table bake(const Mesh& mesh, const AnyScheme& scheme, const BakeOptions& options) {
  const BakeRequest request = request_of(options);
  Patterns patterns(*scheme.for_mesh(mesh));
  Baked baked = bake(patterns, mesh, request);
  if (options.in_double) return Table(AnyTable(std::move(baked.table)));
  return Table(AnyTable(in_float(baked.table)));
}

Fit fit(const Mesh& mesh, const AnyScheme& scheme, const std::vector<VertexTarget>& targets,
        const FitOptions& options) {
  Interpolation found = interpolate(*scheme.for_mesh(mesh), mesh, targets,
                                    {.least_refinements = options.least_refinements,
                                     .most_refinements = options.most_refinements,
                                     .fairness = options.fairness,
                                     .conditioning = false});
  Fit result;
  result.solved = found.solved();
  if (!result.solved) result.why_not = why_unsolved(found.attempts.back());
  result.refinements = found.attempts.back().refinements;
  result.position_error = std::move(found.position_error);
  result.normal_error = std::move(found.normal_error);
  result.mesh = level_mesh(found.level, std::move(found.points), mesh);
  return result;
}

}  // namespace sublimit

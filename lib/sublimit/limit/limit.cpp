// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit.h"

#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/mesh/detail/points_in_space.h"

namespace sublimit {

Limit limit(const Mesh& mesh, const AnyScheme& scheme, const LimitOptions& options) {
  if (options.levels < 0)
    throw InvalidParameter("levels is " + std::to_string(options.levels) + "; it must be 0 or more");
  const Points positions = points_in_space(mesh);
  const AnyScheme for_mesh = scheme.for_mesh(mesh);
  const std::vector<Level> levels = refine(*for_mesh, mesh, options.levels);
  const auto cache = options.cache ? options.cache : std::make_shared<LimitCache>(*for_mesh);
  LimitMatrices rows = limit_matrices(levels, *cache);
  const SparseMatrix P = refinement_matrix(levels);
  const Topology& topology = levels.back().topology();
  const Points at_level = apply(P, positions);
  LimitPoints limits = limit_points(rows, topology, at_level);
  Limit all;
  all.points.swap(limits.position);
  all.normals.swap(limits.normal);
  all.tangent1 = apply(rows.tangent1, at_level);
  all.tangent2 = apply(rows.tangent2, at_level);
  all.status = std::move(limits.status);
  all.side_vertex = std::move(rows.side_vertex);
  all.corner_side = std::move(rows.corner_side);
  for (Index f = 0; f < topology.num_faces(); ++f) {
    all.face_sizes.push_back(topology.size(Face{f}));
    const auto corners = topology.vertices(Face{f});
    all.face_vertices.insert(all.face_vertices.end(), corners.begin(), corners.end());
  }
  product(rows.position, P).swap(all.matrix);
  product(rows.tangent1, P).swap(all.tangent1_matrix);
  product(rows.tangent2, P).swap(all.tangent2_matrix);
  return all;
}

std::shared_ptr<LimitCache> limit_cache(const AnyScheme& scheme) { return std::make_shared<LimitCache>(*scheme); }

}  // namespace sublimit

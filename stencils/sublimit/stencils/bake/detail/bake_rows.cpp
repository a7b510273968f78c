// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/bake_rows.h"

#include <algorithm>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/stencils/patterns/point_status.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {
namespace {

/// Matrices one below the other.
StencilTable<double> stacked(const std::vector<SparseMatrix>& parts) {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  std::vector<double> weights;
  for (const SparseMatrix& S : parts) {
    const std::int64_t before = offsets.back();
    for (Index r = 0; r < S.rows(); ++r) offsets.push_back(before + S.outerIndexPtr()[r + 1]);
    columns.insert(columns.end(), S.innerIndexPtr(), S.innerIndexPtr() + S.nonZeros());
    weights.insert(weights.end(), S.valuePtr(), S.valuePtr() + S.nonZeros());
  }
  return StencilTable<double>(static_cast<std::int32_t>(parts[0].cols()), std::move(offsets), std::move(columns),
                              std::move(weights));
}

/// Limits of the vertices of the last level, with the tangents of one side each.
void add_limits(const Scheme<double>& scheme, const std::vector<Level>& levels, int derivatives, Baked& baked,
                PatternTable<double>::Arrays& arrays) {
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(levels, cache);
  const SparseMatrix P = refinement_matrix(levels);
  const Topology& t = levels.back().topology();
  std::vector<Index> side(t.num_vertices(), -1);
  for (Index s = static_cast<Index>(limit.side_vertex.size()); s-- > 0;) side[limit.side_vertex[s]] = s;
  std::vector<SparseMatrix> parts{SparseMatrix(limit.position * P)};
  std::vector<std::uint8_t> status(t.num_vertices(), point_status(LimitStatus::undefined_normal, 0, derivatives));
  for (Index v = 0; v < t.num_vertices(); ++v) {
    if (side[v] < 0) continue;
    const LimitStatus of = limit.status[side[v]];
    const bool natural = of == LimitStatus::regular || of == LimitStatus::crease;
    status[v] = point_status(of, natural ? 1 : 0, derivatives);
  }
  if (derivatives > 0)
    for (const SparseMatrix* tangent : {&limit.tangent1, &limit.tangent2}) {
      SparseMatrix chosen(t.num_vertices(), tangent->cols());
      for (Index v = 0; v < t.num_vertices(); ++v) {
        chosen.startVec(v);
        if (side[v] < 0) continue;
        for (SparseMatrix::InnerIterator it(*tangent, side[v]); it; ++it) chosen.insertBack(v, it.col()) = it.value();
      }
      chosen.finalize();
      parts.push_back(SparseMatrix(chosen * P));
    }
  arrays.rest = stacked(parts);
  if (std::any_of(status.begin(), status.end(), [](std::uint8_t s) { return s != 0; }))
    baked.table.rest_status = std::move(status);
}

}  // namespace

FaceList face_list(const Level& level) {
  const Topology& t = level.topology();
  std::vector<std::int32_t> sizes, corners;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (level.holes[f]) continue;
    const std::span<const Index> vertices = t.vertices(Face{f});
    sizes.push_back(static_cast<std::int32_t>(vertices.size()));
    corners.insert(corners.end(), vertices.begin(), vertices.end());
  }
  return {std::move(sizes), std::move(corners)};
}

void add_places(const LinearSource& surface, std::span<const Place> samples, int derivatives, Baked& baked,
                PatternTable<double>::Arrays& arrays) {
  const auto count = static_cast<std::int64_t>(samples.size());
  const int quantities = arrays.quantities;
  // About, a row; the stencils and the table that is made of them.
  check_memory(std::to_string(count) + " stencils", double(count) * quantities * 40 * 12 * 2, "use fewer places");
  constexpr std::int64_t per_block = 256;
  struct Rows {
    std::vector<std::int32_t> sizes, columns;
    std::vector<double> weights;
  };
  std::vector<Rows> rows(size_t(quantities * num_blocks(count, per_block)));
  std::vector<std::uint8_t> status(samples.size());
  const std::int64_t blocks = num_blocks(count, per_block);
  parallel_for_blocks(
      count,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const LimitStencil stencil = surface.stencil(samples[i], derivatives);
          const int order = stencil.weights.rows() == 6 ? 2 : stencil.weights.rows() == 3 ? 1 : 0;
          status[i] = point_status(stencil.status, order, derivatives);
          for (Eigen::Index q = 0; q < quantities; ++q) {
            Rows& to = rows[size_t(q * blocks + block)];
            // Where there are no natural derivatives, two tangents that span the plane.
            const bool tangent = q > 0 && q < 3 && stencil.weights.rows() == 1 && stencil.tangents.rows() >= 2;
            const bool exists = q < stencil.weights.rows() || tangent;
            std::int32_t size = 0;
            for (size_t j = 0; j < stencil.vertices.size() && exists; ++j) {
              const double weight =
                  tangent ? stencil.tangents(q - 1, Eigen::Index(j)) : stencil.weights(q, Eigen::Index(j));
              if (weight == 0) continue;
              to.columns.push_back(stencil.vertices[j]);
              to.weights.push_back(weight);
              ++size;
            }
            to.sizes.push_back(size);
          }
        }
      },
      per_block);
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  std::vector<double> weights;
  for (Rows& part : rows) {
    for (const std::int32_t size : part.sizes) offsets.push_back(offsets.back() + size);
    columns.insert(columns.end(), part.columns.begin(), part.columns.end());
    weights.insert(weights.end(), part.weights.begin(), part.weights.end());
    part = {};
  }
  arrays.rest = StencilTable<double>(surface.num_points(), std::move(offsets), std::move(columns), std::move(weights));
  if (std::any_of(status.begin(), status.end(), [](std::uint8_t s) { return s != 0; }))
    baked.table.rest_status = std::move(status);
}

void set_samples(const BakeRequest& request, Baked& baked) {
  std::vector<std::int32_t> faces;
  std::vector<double> parameters;
  for (const Place& s : request.samples) {
    faces.push_back(s.face);
    parameters.insert(parameters.end(), {s.u, s.v});
  }
  baked.table.addresses = {std::move(faces), std::move(parameters)};
  baked.table.faces = {request.face_sizes, request.face_vertices};
}

std::vector<std::int32_t> grid_copies(const Topology& t, const Addresses& addresses, int N, bool dual) {
  std::vector<std::int32_t> list;
  for (const auto& [to, from] : shared_grid_places(t, addresses, N, dual)) {
    list.push_back(static_cast<std::int32_t>(to));
    list.push_back(static_cast<std::int32_t>(from));
  }
  return list;
}

StencilTable<double> as_table(const SparseMatrix& S) { return stacked({S}); }

Baked bake_by_rows(Patterns& patterns, const Level& control, const BakeRequest& request) {
  const Scheme<double>& scheme = patterns.scheme();
  Baked baked;
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  const Index num_control_points = control.topology().num_vertices();
  if (request.rows == TableRows::level || request.rows == TableRows::limit) {
    const std::vector<Level> levels = refine(scheme, control, request.level);
    if (request.rows == TableRows::limit) {
      if (request.derivatives > 1)
        throw InvalidParameter(scheme.name +
                               ": second derivatives at the vertices of a level are known where faces are cut into "
                               "four of their kind; take a grid");
      add_limits(scheme, levels, request.derivatives, baked, arrays);
    } else {
      arrays.rest = as_table(refinement_matrix(levels));
    }
    baked.table.faces = face_list(levels.back());
  } else {
    const LimitMap surface(scheme, control, patterns.types());
    if (request.rows == TableRows::grid) {
      add_places(surface, surface.grid(request.grid), request.derivatives, baked, arrays);
      arrays.copies = grid_copies(control.topology(), surface.addresses(), request.grid, scheme.is_dual());
    } else {
      add_places(surface, request.samples, request.derivatives, baked, arrays);
      set_samples(request, baked);
    }
  }
  baked.table.table = PatternTable<double>(num_control_points, std::move(arrays));
  baked.statistics.method = BakeMethod::rows;
  return baked;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/place_stencils.h"

#include <cstdint>
#include <limits>
#include <string>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {

PlaceStencils place_stencils(const LinearSource& surface, std::span<const Place> places, int derivatives) {
  check_order(derivatives);
  std::vector<LimitStencil> rows(places.size());
  parallel_for_blocks(
      std::ssize(rows),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) rows[size_t(i)] = surface.stencil(places[size_t(i)], derivatives);
      },
      256);
  double entries = 0;
  for (const LimitStencil& row : rows) entries += double(row.vertices.size());
  if (entries > std::numeric_limits<Index>::max())
    throw ResourceError("stencils of " + std::to_string(places.size()) +
                        " places have more weights than 32-bit indices count; take fewer places at a time");
  PlaceStencils all;
  for (const LimitStencil& row : rows) all.status.push_back(row.status);
  for (Eigen::Index q = 0; q < (derivatives == 0 ? 1 : derivatives == 1 ? 3 : 6); ++q) {
    SparseMatrix& matrix = all.matrices.emplace_back(Index(places.size()), surface.num_points());
    matrix.reserve(Eigen::Index(entries));
    for (size_t i = 0; i < rows.size(); ++i) {
      matrix.startVec(Eigen::Index(i));
      if (q >= rows[i].weights.rows()) continue;
      for (size_t k = 0; k < rows[i].vertices.size(); ++k)
        matrix.insertBack(Eigen::Index(i), rows[i].vertices[k]) = rows[i].weights(q, Eigen::Index(k));
    }
    matrix.finalize();
  }
  return all;
}

}  // namespace sublimit

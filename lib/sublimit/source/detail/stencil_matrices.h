// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils of many places of a surface or of curves as matrices.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/source/detail/derivative_order.h"
#include "sublimit/source/place_stencils.h"

namespace sublimit {

/// Returns the stencils of places as matrices: matrix q has row q of each stencil, empty if there is none.
/// @param source    its `stencil(place, derivatives)` returns a stencil with weights and a status
/// @param columns   numbers of the columns of a stencil's weights, ascending
/// @param matrices  number of matrices
/// @param width     number of columns of the matrices
/// @throws InvalidParameter  another number of derivatives than 0, 1 or 2, and what `stencil` refuses
/// @throws ResourceError     more weights than 32-bit indices count
template <class Source, class Where, class Stencil>
PlaceStencils stencil_matrices(const Source& source, std::span<const Where> places, int derivatives,
                               std::vector<Index> Stencil::*columns, Eigen::Index matrices, Index width) {
  check_order(derivatives);
  std::vector<Stencil> rows(places.size());
  parallel_for_blocks(
      std::ssize(rows),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) rows[size_t(i)] = source.stencil(places[size_t(i)], derivatives);
      },
      256);
  double entries = 0;
  for (const Stencil& row : rows) entries += double((row.*columns).size());
  if (entries > std::numeric_limits<Index>::max())
    throw ResourceError("stencils of " + std::to_string(places.size()) +
                        " places have more weights than 32-bit indices count; take fewer places at a time");
  PlaceStencils all;
  for (const Stencil& row : rows) all.status.push_back(row.status);
  for (Eigen::Index q = 0; q < matrices; ++q) {
    SparseMatrix& matrix = all.matrices.emplace_back(Index(places.size()), width);
    matrix.reserve(Eigen::Index(entries));
    for (size_t i = 0; i < rows.size(); ++i) {
      matrix.startVec(Eigen::Index(i));
      if (q >= rows[i].weights.rows()) continue;
      const std::vector<Index>& numbers = rows[i].*columns;
      for (size_t k = 0; k < numbers.size(); ++k)
        matrix.insertBack(Eigen::Index(i), numbers[k]) = rows[i].weights(q, Eigen::Index(k));
    }
    matrix.finalize();
  }
  return all;
}

}  // namespace sublimit

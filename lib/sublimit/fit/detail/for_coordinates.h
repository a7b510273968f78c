// SPDX-License-Identifier: Apache-2.0
#pragma once
// Expansion of a matrix over points to one over all coordinates of all points, interleaved (x, y, z of the
// first point, ...).
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/types.h"

namespace sublimit {

/// Returns M applied to each of three interleaved coordinates: 3 #rows x 3 #columns.
/// @throws ResourceError  more entries than 32-bit indices count
inline SparseMatrix for_coordinates(const SparseMatrix& M) {
  if (3 * std::max<Eigen::Index>(M.nonZeros(), std::max(M.rows(), M.cols())) > std::numeric_limits<Index>::max())
    throw ResourceError(
        "a matrix for three coordinates has more entries than 32-bit indices count; use a smaller mesh");
  SparseMatrix result(3 * M.rows(), 3 * M.cols());
  result.reserve(3 * M.nonZeros());
  for (Index r = 0; r < M.rows(); ++r)
    for (Index c = 0; c < 3; ++c) {
      result.startVec(3 * r + c);
      for (SparseMatrix::InnerIterator it(M, r); it; ++it)
        result.insertBack(3 * r + c, 3 * static_cast<Index>(it.col()) + c) = it.value();
    }
  result.finalize();
  return result;
}

}  // namespace sublimit

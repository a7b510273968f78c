// SPDX-License-Identifier: Apache-2.0
#pragma once
// How well conditions determine control points: singular values of their matrix, its rank, and what is free.
#include "sublimit/types.h"

namespace sublimit {

struct Conditioning {
  Index rows = 0, columns = 0;
  Index rank = 0;                    ///< singular values above the tolerance
  double largest = 0, smallest = 0;  ///< of those
  /// The least singular values, ascending, those below the tolerance among them; of small matrices all of them. At most
  /// min(rows, columns).
  Eigen::VectorXd singular_values;
  Points free;       ///< columns x (number found): directions of x that no row sees, orthonormal
  Points dependent;  ///< rows x (number found): combinations of rows that vanish, orthonormal
  double condition() const { return rank > 0 ? largest / smallest : 0; }
};

/// @param tolerance  of singular values, relative to the largest one
/// @note  A dense decomposition up to some hundred columns, above that the ends of the spectrum by inverse iteration.
/// Of more
///        than `most_directions` vanishing directions only so many are returned, and the rank is a bound from above.
Conditioning conditioning(const SparseMatrix& rows, double tolerance = 1e-10, Index most_directions = 64);

}  // namespace sublimit

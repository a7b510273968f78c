// SPDX-License-Identifier: Apache-2.0
#pragma once
// How well conditions determine control points: singular values of their matrix, its rank, and what is free.
#include "sublimit/core/types.h"

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

/// A dense decomposition up to 600 rows or columns. Above that the ends of the spectrum: `largest` from below, the
/// least ones from above, to 1e-9 where they keep apart, to 1e-2 where thousands crowd (on grids of 100k); zeros are
/// zero to rounding. Directions that are there by shape alone (free ones where there are fewer rows than columns,
/// dependent ones where there are more) are listed by the dense decomposition only.
/// @param tolerance  of singular values, relative to the largest one
/// @note  Of more than `most_directions` vanishing directions only so many are found, and the rank is a bound from
/// above. Deterministic.
/// @throws InvalidParameter  weights that are not finite, a negative tolerance
/// @throws ResourceError     factors larger than memory
/// @throws AnalysisError     a decomposition that breaks down
Conditioning conditioning(const SparseMatrix& rows, double tolerance = 1e-10, Index most_directions = 64);

}  // namespace sublimit

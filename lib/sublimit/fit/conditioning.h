// SPDX-License-Identifier: Apache-2.0
#pragma once
// How well linear conditions determine control points: rank and singular values of their matrix, and the directions
// that it leaves free.
//
//   const SparseMatrix rows = place_rows(surface.map(), places);
//   const Conditioning found = conditioning(rows);
//   if (found.rank < found.columns) std::cout << found.free.cols() << " directions are free\n";
#include "sublimit/core/types.h"

namespace sublimit {

/// Rank, singular values and null spaces of a matrix. Plain data.
struct Conditioning {
  Index rows = 0, columns = 0;
  Index rank = 0;                    ///< number of singular values above the tolerance
  double largest = 0, smallest = 0;  ///< largest and smallest singular value above the tolerance
  /// The least singular values, ascending, including those below the tolerance; all of them for small matrices. At most
  /// min(rows, columns).
  Eigen::VectorXd singular_values;
  Points free;       ///< orthonormal basis of {x: rows * x = 0}, as far as computed, in columns
  Points dependent;  ///< orthonormal basis of the combinations of rows that vanish, as far as computed, in columns
  /// Returns the condition number, largest / smallest; 0 for rank 0.
  double condition() const { return rank > 0 ? largest / smallest : 0; }
};

/// Returns rank, singular values and null spaces of a matrix of conditions.
///
/// Matrices of up to 600 rows or columns are decomposed densely. For larger ones the ends of the spectrum are iterated:
/// `largest` is approached from below, the least ones from above, to 1e-9 where they are separated, to 1e-2 where
/// thousands cluster (grids of 100k points); zeros are zero to rounding. Directions that exist by shape alone (free
/// ones with fewer rows than columns, dependent ones with more) are listed by the dense decomposition only.
/// @param tolerance        singular values below it, relative to the largest one, count as zero
/// @param most_directions  largest number of free or dependent directions that are computed; with more of them the rank
///                         is an upper bound
/// @note  Deterministic.
/// @throws InvalidParameter  weights that are not finite, a negative tolerance
/// @throws ResourceError     factors larger than memory
/// @throws AnalysisError     a decomposition that breaks down
Conditioning conditioning(const SparseMatrix& rows, double tolerance = 1e-10, Index most_directions = 64);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Products of stencil matrices with points and with each other, in parallel blocks of rows. Every row is summed in the
// order of its columns, so the bits do not depend on the number of threads.
#include "sublimit/core/types.h"

namespace sublimit {

/// Returns S * points: the new points, one row per row of S.
/// @throws InvalidParameter  as many points as S has columns are needed
[[nodiscard]] Points apply(const SparseMatrix& S, const Points& points);

/// Returns A * B, columns of a row ascending.
/// @throws InvalidParameter  the shapes do not fit
/// @throws ResourceError     more nonzeros than 32-bit indices
[[nodiscard]] SparseMatrix product(const SparseMatrix& A, const SparseMatrix& B);

}  // namespace sublimit

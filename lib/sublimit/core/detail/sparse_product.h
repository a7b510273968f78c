// SPDX-License-Identifier: Apache-2.0
#pragma once
// Products of stencil matrices with points and with each other, in parallel blocks of rows. Every row is summed in the
// order of its columns, so the bits do not depend on the number of threads.
#include "sublimit/core/types.h"

namespace sublimit {

/// Returns S * points: the new points, one row per row of S.
/// @throws InvalidParameter  another number of points than S has columns
[[nodiscard]] Points apply(const SparseMatrix& S, const Points& points);

/// Returns A * B, columns of a row ascending.
/// @throws InvalidParameter  shapes that do not match
/// @throws ResourceError     more nonzeros than 32-bit indices count
[[nodiscard]] SparseMatrix product(const SparseMatrix& A, const SparseMatrix& B);

}  // namespace sublimit

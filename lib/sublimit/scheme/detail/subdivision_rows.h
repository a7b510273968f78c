// SPDX-License-Identifier: Apache-2.0
#pragma once
// Some rows of a subdivision matrix, where a level is large and few of its points are asked for.
#include <span>

#include "sublimit/scheme/refine.h"
#include "sublimit/scheme/subdivision_matrix.h"

namespace sublimit {

/// Returns some rows of `subdivision_matrix`, with the same bits; the other rows are empty.
/// @param rows  child vertices whose rows are wanted, ascending
SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Step<double>& step, const Topology& parent,
                              const Refinement& refinement, const Sharpness& sharpness,
                              const Sharpness& child_sharpness, int level, std::span<const Index> rows,
                              const KnotSplit* knots = nullptr);

/// Rows of the matrix from a level to the next one: of these vertices, and where a level takes several steps all that
/// there are.
/// @param vertices  of the next level, ascending
SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Level& parent, const Level& child,
                              std::span<const Index> vertices);

}  // namespace sublimit

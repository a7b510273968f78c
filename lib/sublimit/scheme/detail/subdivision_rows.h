// SPDX-License-Identifier: Apache-2.0
#pragma once
// Single rows of a subdivision matrix, for a few points of a large level.
#include <span>

#include "sublimit/scheme/refine.h"
#include "sublimit/scheme/subdivision_matrix.h"

namespace sublimit {

/// Returns some rows of `subdivision_matrix`, with the same bits; the other rows are empty.
/// @param rows  child vertices whose rows are computed, ascending
SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Step<double>& step, const Topology& parent,
                              const Refinement& refinement, const Sharpness& sharpness,
                              const Sharpness& child_sharpness, int level, std::span<const Index> rows,
                              const KnotSplit* knots = nullptr);

/// Returns the matrix from a level to the next one with the rows of some vertices; with all rows if a level has
/// several steps.
/// @param vertices  vertices of the next level, ascending
SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Level& parent, const Level& child,
                              std::span<const Index> vertices);

}  // namespace sublimit

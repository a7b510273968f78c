// SPDX-License-Identifier: Apache-2.0
#pragma once
// Subdivision in one line for meshes that are Eigen matrices.
#include <string>
#include <utility>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Faces as rows of equal length (`F` of libigl and friends).
using FaceMatrix = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// For Eigen users, in one line: `auto [S, F1] = subdivide("loop", V.rows(), F, 2); V1 = S * V;`
/// @param F  #F x 3 or #F x 4, counter-clockwise
/// @return   the product of the levels' matrices, and the refined faces
/// @throws InvalidOption  an unknown scheme; and whatever `refine` throws
[[nodiscard]] std::pair<SparseMatrix, FaceMatrix> subdivide(const std::string& scheme, Index num_vertices,
                                                            const FaceMatrix& F, int levels = 1,
                                                            const SubdivisionOptions& options = {});

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Subdivision in one line for meshes that are Eigen matrices:
//
//   const FaceMatrix F{{0, 1, 2}, {0, 2, 3}};
//   const Points V{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   const auto [S, F1] = subdivide("loop", Index(V.rows()), F, 2);
//   const Points V1 = S * V;
#include <string>
#include <utility>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Faces of equal size, one in each row (`F` of libigl).
using FaceMatrix = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Refines a mesh.
/// @param scheme  name of a scheme, with its default options
/// @param F       #F x 3 or #F x 4, counter-clockwise
/// @param levels  number of refinements
/// @return        the product of the levels' matrices, and the refined faces
/// @throws InvalidOption                     an unknown scheme
/// @throws InvalidParameter                  negative `levels`
/// @throws InvalidMesh, UnsupportedTopology  faces that the scheme cannot refine: says which
/// @throws ResourceError                     more memory than there is
[[nodiscard]] std::pair<SparseMatrix, FaceMatrix> subdivide(const std::string& scheme, Index num_vertices,
                                                            const FaceMatrix& F, int levels = 1,
                                                            const SubdivisionOptions& options = {});

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// The simple primvars, carried along a refinement: `varying` (a value per vertex, linear over the split) and `uniform`
// (a value per face, inherited). What is `vertex` goes by refinement_matrix; what is `face-varying` by face_varying.h.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Varying values of the last level from those of the control vertices: midpoints on edges, centroids in faces.
/// @param levels  0 to k of one mesh under `scheme`
/// @return  #V_k x #V_0, rows non-negative and of sum 1
/// @throws InvalidParameter  no levels
/// @throws InvalidOption     a scheme whose split does not keep vertices and edges: there is nothing to be linear along
SparseMatrix varying_matrix(const Scheme<double>& scheme, std::span<const Level> levels);

/// Control face that each face of the last level descends from; under splits with faces for edges and vertices one of
/// those around.
/// @throws InvalidParameter  no levels
std::vector<Index> uniform_parents(std::span<const Level> levels);
/// Returns the matrix that copies values of faces to level k, #F_k x #F_0: a one in every row.
SparseMatrix uniform_matrix(std::span<const Level> levels);

}  // namespace sublimit

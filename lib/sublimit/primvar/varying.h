// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refinement of simple primvars: `varying` (a value per vertex, interpolated linearly over the split) and
// `uniform` (a value per face, inherited). For `vertex` use refinement_matrix, for `face-varying`
// face_varying.h.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns the matrix from varying values of control vertices to those of the last level: midpoints on edges,
/// centroids in faces.
/// @param levels  levels 0 to k of a mesh, refined by `scheme`
/// @return  #V_k x #V_0; rows are non-negative and sum to 1
/// @throws InvalidParameter  no levels
/// @throws InvalidOption     a scheme whose split does not keep vertices and edges
SparseMatrix varying_matrix(const Scheme<double>& scheme, std::span<const Level> levels);

/// Returns the control face that each face of the last level descends from; for splits with faces for edges and
/// vertices, one of the faces around.
/// @throws InvalidParameter  no levels
std::vector<Index> uniform_parents(std::span<const Level> levels);
/// Returns the matrix that copies values of faces to level k, #F_k x #F_0: a one in every row.
SparseMatrix uniform_matrix(std::span<const Level> levels);

}  // namespace sublimit

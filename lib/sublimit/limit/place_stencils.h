// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils of many places, as matrices over the control points.
#include <span>
#include <vector>

#include "sublimit/limit/linear_source.h"

namespace sublimit {

/// A row for each place, over the control points. Rows of what does not exist at a place are empty.
struct [[nodiscard]] PlaceStencils {
  /// Matrices for the position, then du, dv, then duu, duv, dvv: 1, 3 or 6 of them, as many as were asked for.
  std::vector<SparseMatrix> matrices;
  std::vector<LimitStatus> status;  ///< of each place
};

/// Returns the stencils of places of a surface.
/// @param derivatives  0, 1 or 2
/// @throws InvalidParameter  a place on no face, parameters outside of it, other derivatives
/// @throws ResourceError     more weights than 32-bit indices count
PlaceStencils place_stencils(const LinearSource& surface, std::span<const Sample> places, int derivatives = 0);

}  // namespace sublimit

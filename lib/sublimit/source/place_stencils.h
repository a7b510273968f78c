// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils of many places, as matrices over the control points: positions and derivatives of moving control points
// become sparse matrix products.
//
//   const PlaceStencils rows = place_stencils(surface.map(), surface.grid(5), 1);
//   const Points positions = rows.matrices[0] * surface.points();
//   const Points du = rows.matrices[1] * surface.points();
#include <span>
#include <vector>

#include "sublimit/source/linear_source.h"

namespace sublimit {

/// Matrices with a row for each place, over the control points. Rows of derivatives that do not exist are empty. Plain
/// data.
struct [[nodiscard]] PlaceStencils {
  /// Matrices for the position, then du, dv, then duu, duv, dvv: 1, 3 or 6 of them, as many as were asked for.
  std::vector<SparseMatrix> matrices;
  std::vector<LimitStatus> status;  ///< status of each place
};

/// Returns the stencils of places of a surface.
/// @param derivatives  0, 1 or 2
/// @throws InvalidParameter  a place on no face, parameters outside of it, another number of derivatives
/// @throws ResourceError     more weights than 32-bit indices count
PlaceStencils place_stencils(const LinearSource& surface, std::span<const Place> places, int derivatives = 0);

}  // namespace sublimit

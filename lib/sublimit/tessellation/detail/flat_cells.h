// SPDX-License-Identifier: Apache-2.0
#pragma once
// Faces of a limit surface cut into quarters, and these again, until each part is known to be nearly flat.
//
// Any triangles whose corners lie on a part of [0, 1]^2 (or of the unit triangle) leave it by no more than
// (|x_uu| + 2 |x_uv| + |x_vv|) / 8, with the largest second derivatives on it: those of a polynomial piece are bounded
// by the second differences of its Bernstein coefficients. Filip, Magedson, Markot 1986, "Surface algorithms using
// bounds on derivatives". Pieces of which only parts are polynomials, as around extraordinary
// vertices, where second derivatives are not bounded, are compared with an affine map of their parameters.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// A polynomial that is kept whole.
struct WholePolynomial {
  std::vector<Points> nets;  ///< Bernstein coefficients; two where it is cut along u = v
  PolynomialBasis basis;
};

struct FlatCell {
  Index address = 0;
  CellCorners corners;
  double bound = 0;                                  ///< how far triangles in it may be from the surface
  std::unique_ptr<WholePolynomial> whole = nullptr;  ///< of cells that are exact; there may be many cells, so apart
};

struct FlatCellOptions {
  double chord = 0;                      ///< that bounds are to keep below
  double angle = 0;                      ///< that normals in a cell may be apart, in radians; 0: any
  std::int64_t max_triangles = 1 << 24;  ///< that cells become
  bool whole_polynomials = false;        ///< a polynomial is one cell, however bent
  /// For each edge of the level how many segments cells are to have along it at least; none: any.
  std::span<const Index> rates = {};
};

/// Cells of all of the surface but its holes, in the order of addresses.
/// @param points  of the level, #V x 3
/// @throws InvalidParameter     points, rates that do not fit
/// @throws UnsupportedTopology  a scheme without polynomial pieces, or with negative weights around other ones, whose
/// hulls are
///                              estimates; pieces whose children are no quarters
/// @throws ResourceError        more triangles than allowed
std::vector<FlatCell> flat_cells(const LimitMap& surface, const Points& points, const FlatCellOptions& options);

}  // namespace sublimit

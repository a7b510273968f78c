// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recursive quartering of the faces of a limit surface until each part is proved to be nearly flat.
//
// Triangles with corners on a part over [0, 1]^2 (or the unit triangle) deviate from it by at most (|x_uu| + 2
// |x_uv| + |x_vv|) / 8, with the maxima of the second derivatives on it. Those of a polynomial piece are
// bounded by the second differences of its Bernstein coefficients. Filip, Magedson, Markot 1986, "Surface
// algorithms using bounds on derivatives". Pieces with unbounded second derivatives, as around extraordinary
// vertices, are compared with an affine map of their parameters.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// The polynomial of an exact cell.
struct WholePolynomial {
  std::vector<Points> nets;  ///< Bernstein coefficients; two nets if the piece is cut along u = v
  PolynomialBasis basis;
};

/// A cell.
struct FlatCell {
  Index address = 0;
  CellCorners corners;
  double bound = 0;                                  ///< bound of the distance of triangles in it from the surface
  std::unique_ptr<WholePolynomial> whole = nullptr;  ///< polynomial of an exact cell; a pointer, to keep cells small
};

/// Options of `flat_cells`.
struct FlatCellOptions {
  double chord = 0;                      ///< largest allowed bound
  double angle = 0;                      ///< largest angle between normals in a cell, radians; 0: any
  std::int64_t max_triangles = 1 << 24;  ///< largest number of triangles that cells become
  bool whole_polynomials = false;        ///< true: each polynomial is one cell, however curved
  /// Least number of segments of cells along each edge of the level; empty: no restriction.
  std::span<const Index> rates = {};
};

/// Returns the cells of the surface without its holes, by ascending address.
/// @param points  points of the surface's level, #V x 3
/// @throws InvalidParameter     points or rates of another size
/// @throws UnsupportedTopology  a scheme without polynomial pieces, or with negative weights in other pieces,
///                              whose bounds would be estimates; pieces whose children are no quarters
/// @throws ResourceError        more than `max_triangles` triangles
std::vector<FlatCell> flat_cells(const LimitMap& surface, const Points& points, const FlatCellOptions& options);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recursive quartering of the faces of a surface until each part is proved to be nearly flat.
//
// Triangles with corners on a part over [0, 1]^2 (or the unit triangle) deviate from it by at most (|x_uu| + 2
// |x_uv| + |x_vv|) / 8, with the maxima of the second derivatives on it. Those of a polynomial piece are
// bounded by the second differences of its Bernstein coefficients. Filip, Magedson, Markot 1986, "Surface
// algorithms using bounds on derivatives". Those of a rational part x = N / w follow from bounds on the derivatives of
// N and w, about the middle of its control points. Pieces with unbounded second derivatives, as around extraordinary
// vertices, are compared with an affine map of their parameters.
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
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
  /// Returns the greatest lengths of cells along the sides of an address; none: no restriction.
  std::function<std::array<std::int32_t, 4>(Index address)> longest_sides = {};
};

/// Appends the parts of a face that is no hole; called by several threads, each with a cutter of its own.
using FindParts = std::function<void(Index face, PieceParts& cutter, std::vector<PiecePart>& out)>;

/// Returns the cells of a surface, by ascending address.
/// @param find_parts  parts without a polynomial have their types, and children that are quarters
/// @throws UnsupportedTopology  parts whose bounds would be estimates, or whose children are no quarters
/// @throws ResourceError        more than `max_triangles` triangles
std::vector<FlatCell> flat_cells(FaceCount faces, const FindParts& find_parts, const FlatCellOptions& options);

/// Returns the cells of a limit surface without its holes, by ascending address.
/// @param points  points of the surface's level, #V x 3
/// @throws InvalidParameter     points of another size; a chord or angle that is smaller than what is rounded
/// @throws UnsupportedTopology  a scheme without polynomial pieces, or with negative weights in other pieces,
///                              whose bounds would be estimates; pieces whose children are no quarters
/// @throws ResourceError        more than `max_triangles` triangles
std::vector<FlatCell> flat_cells(const LimitMap& surface, const Points& points, const FlatCellOptions& options);

/// Throws if cells would be cut for nothing, until there are too many of them.
/// @param points  control points, #points x 3
/// @throws InvalidParameter  a chord or an angle that is smaller than what points or normals are rounded to
void check_above_rounding(const Points& points, const FlatCellOptions& options);

}  // namespace sublimit

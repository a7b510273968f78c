// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial pieces on regular meshes: their control points, including those beyond borders and sharp edges,
// and their bases in 256-bit floats by recursions of splines, without refinement.
#include <optional>
#include <vector>

#include "sublimit/scheme/refine.h"
#include "truth/brute_force.h"
#include "truth/place_descent.h"

namespace sublimit::testing {

/// Kind of the limits of regular meshes.
struct Spline {
  enum class Kind {
    none,          ///< no polynomial pieces
    tensor,        ///< B-splines of bidegree `degree`
    quartic,       ///< box spline of Loop's scheme
    zwart_powell,  ///< box spline of mid-edge
  };
  Kind kind = Kind::none;
  int degree = 0;
  bool looks_across = false;  ///< points on edges of quads have other weights if the face across is not a quad
};
Spline spline_of(const Scheme<Precise>& scheme);

/// Returns true if the vertex of a corner is regular as seen from the corner's face: smooth with `valence`
/// faces, or on a border or crease with half as many faces between sharp edges.
bool is_regular_corner(const Level& level, HalfEdge corner, Index valence);

/// Value and derivatives x, y, xx, xy, yy of a polynomial piece, in rows.
struct PieceValues {
  Eigen::Matrix<Precise, 6, Eigen::Dynamic> rows;
  bool inside = true;  ///< false on the border of the piece
};

/// Returns the values of the piece that contains a place; absent unless it is a polynomial. For that its
/// support must be regular, or end at borders or infinitely sharp edges with regular vertices, beyond which
/// p_-i = 2 p_0 - p_i (quartic: parallelograms) is equivalent to the masks of the border.
/// @param strays  for dual schemes: vertices that borders have moved off their natural positions; may be empty
std::optional<PieceValues> piece(const Spline& spline, const Level& level, const PrecisePoints& points,
                                 const std::vector<char>& strays, const DescentPlace& place);

}  // namespace sublimit::testing

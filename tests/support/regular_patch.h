// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial pieces of regular meshes: which control points they have, those beyond borders and sharp edges included,
// and their bases in 256-bit floats by the recursions of splines, which know no refinement.
#include <optional>
#include <vector>

#include "sublimit/scheme/refine.h"
#include "support/brute_force.h"
#include "support/place_descent.h"

namespace sublimit::testing {

/// What the limits of regular meshes are.
struct Spline {
  enum class Kind {
    none,          ///< no polynomial pieces
    tensor,        ///< B-splines of bidegree `degree`
    quartic,       ///< box spline of Loop's scheme
    zwart_powell,  ///< box spline of mid-edge
  };
  Kind kind = Kind::none;
  int degree = 0;
  bool looks_across = false;  ///< points on edges of quads have other weights where the face across is none
};
Spline spline_of(const Scheme<Precise>& scheme);

/// Is the vertex that a corner starts in, seen from the corner's face, like those of regular meshes: smooth with
/// `valence` faces, or on a border or crease with half as many between sharp edges?
bool is_regular_corner(const Level& level, HalfEdge corner, Index valence);

/// Value and derivatives x, y, xx, xy, yy of a polynomial piece, one row each.
struct PieceValues {
  Eigen::Matrix<Precise, 6, Eigen::Dynamic> rows;
  bool inside = true;  ///< not on the border of the piece
};

/// The piece that contains the place, if it is a polynomial: its whole support is regular, or ends at borders or
/// infinitely sharp edges with regular vertices, beyond which p_-i = 2 p_0 - p_i (quartic: parallelograms) gives what
/// the border's masks give.
/// @param strays  vertices of dual schemes that borders have moved off their natural place; empty for none
std::optional<PieceValues> piece(const Spline& spline, const Level& level, const PrecisePoints& points,
                                 const std::vector<char>& strays, const DescentPlace& place);

}  // namespace sublimit::testing

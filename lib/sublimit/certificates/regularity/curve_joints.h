// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the pieces of a polynomial curve meet: C^n if their derivatives up to order n agree, G^n if they do after the
// parameter of one piece is changed. The change may be anything regular: its first derivative, the ratio of the
// tangents, must be positive (else the curve turns back: a cusp), higher ones are free, of any sign.
#include <Eigen/Core>

#include <string>
#include <vector>

namespace sublimit {

/// Bezier control points, one a row; every piece takes a unit of the parameter.
struct BezierCurve {
  std::vector<Eigen::MatrixXd> pieces;
  bool closed = false;  ///< the last piece is followed by the first
};

struct CurveJoint {
  int piece = 0;                 ///< the one that ends here
  int c = -1, g = -1;            ///< largest orders found; -1: a gap. At most the degree of the pieces
  bool g_is_least = false;       ///< no order up to the degree fails: g may be more
  bool same_polynomial = false;  ///< all derivatives agree: no knot at all
  bool has_tangents = false;     ///< neither derivative vanishes
  double gap = 0;                ///< distance of the ends
  /// Derivatives of the parameter of the piece before by that of the piece after, as far as G^g goes (and the first, if
  /// the tangents are parallel).
  std::vector<double> ratios;
  double residual = 0;  ///< of the first order that fails, relative
  std::string because;
};

/// @param tolerance  relative to the size of the curve and its derivatives; numbers are floating ones
/// @throws InvalidMesh  no pieces, pieces of one point or of different dimensions
std::vector<CurveJoint> curve_joints(const BezierCurve& curve, double tolerance = 1e-9);

/// A curve from text: lines `piece,x,y` or `piece,x,y,z` after that header, the control points of a piece in order,
/// pieces numbered from 0 on. `closed` on a line of its own closes it; `#` begins a comment.
/// @throws FormatError  with the line
BezierCurve read_bezier_curve(const std::string& text);

}  // namespace sublimit

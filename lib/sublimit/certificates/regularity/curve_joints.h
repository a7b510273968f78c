// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity between the pieces of a polynomial curve: C^n if derivatives up to order n agree, G^n if they
// agree after a regular change of the parameter of one piece. The first derivative of the change, the ratio of
// the tangents, must be positive (else there is a cusp); higher ones are arbitrary.
#include <Eigen/Core>

#include <string>
#include <vector>

namespace sublimit {

/// Bezier pieces, a control point per row; each has a parameter interval of length 1.
struct BezierCurve {
  std::vector<Eigen::MatrixXd> pieces;
  bool closed = false;  ///< the last piece is followed by the first
};

/// Continuity at a joint.
struct CurveJoint {
  int piece = 0;                 ///< the piece that ends here
  int c = -1, g = -1;            ///< largest orders, at most the degree of the pieces; -1: a gap
  bool g_is_least = false;       ///< true if no order up to the degree fails: g may be larger
  bool same_polynomial = false;  ///< true if all derivatives agree: no knot is needed
  bool has_tangents = false;     ///< true if neither first derivative vanishes
  double gap = 0;                ///< distance of the ends
  /// Derivatives of the parameter of the previous piece by that of the next one, up to order g (and at least
  /// the first, if the tangents are parallel).
  std::vector<double> ratios;
  double residual = 0;  ///< relative residual of the first order that fails
  std::string because;
};

/// Returns the continuity at all joints, in floating-point arithmetic.
/// @param tolerance  relative to the size of the curve and its derivatives
/// @throws InvalidMesh  no pieces, pieces of one point or of different dimensions
std::vector<CurveJoint> curve_joints(const BezierCurve& curve, double tolerance = 1e-9);

/// Returns a curve from text: lines `piece,x,y` or `piece,x,y,z` after that header, the control points of a
/// piece in order, pieces numbered from 0 on. `closed` on a line of its own closes it; `#` begins a comment.
/// @throws FormatError  names the line
BezierCurve read_bezier_curve(const std::string& text);

}  // namespace sublimit

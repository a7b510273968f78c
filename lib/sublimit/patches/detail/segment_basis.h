// SPDX-License-Identifier: Apache-2.0
#pragma once
// Piecewise polynomials in one variable whose segments have the same basis. A segment depends on degree + 1
// control points, and the next one on those `step` points further. The basis is a matrix of coefficients of
// powers of t in [0, 1]. Rows are computed from the Bezier form of a segment, whose control points are blossoms
// of the powers.
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/knots.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// A piecewise polynomial basis in one variable.
class SegmentBasis {
 public:
  /// @param step    number of control points from the start of a segment to that of the next
  /// @param powers  (degree + 1)^2 numbers: row i has the coefficients of control point i, that of t^0 first
  /// @param breaks  ends of the segments, ascending; one more than there are segments
  /// @throws InvalidParameter  another number of entries, a degree above `max_degree`, a step below 1, breaks that do
  ///                           not rise, numbers that are not finite
  SegmentBasis(int degree, Index step, std::span<const double> powers, std::vector<double> breaks);
  /// Returns the Catmull-Rom basis (1974): cubic segments that interpolate all points but the first and the
  /// last.
  static SegmentBasis cardinal(std::vector<double> breaks);
  /// Returns the power basis: control points are the coefficients of the powers of t.
  static SegmentBasis taylor(int degree, std::vector<double> breaks);

  int degree() const { return degree_; }
  Index num_faces() const { return static_cast<Index>(breaks_.size()) - 1; }
  Index num_points() const { return step_ * (num_faces() - 1) + degree_ + 1; }
  /// Returns the first of the degree + 1 control points of a segment.
  Index first_point(Index face) const { return step_ * face; }

  /// Computes the weights of a segment's control points: rows of the position, then of derivatives per unit of
  /// t.
  /// @param rows  result, (order + 1) (degree + 1) numbers
  void rows(double t, int order, std::span<double> rows) const;

  /// Returns k of C^k, up to 2, between a segment and the next or the previous one; -1 for a jump, 3 at the
  /// ends.
  int continuity(Index face, KnotSide end) const;

  const std::vector<double>& breaks() const { return breaks_; }
  double length(Index face) const { return breaks_[size_t(face) + 1] - breaks_[size_t(face)]; }
  /// Returns the place of a parameter.
  /// @throws InvalidParameter  a parameter outside the domain
  KnotPlace<double> place(double t, KnotSide side) const;
  /// Returns the parameter of a place.
  double parameter(const KnotPlace<double>& place) const;

  /// Returns the Bezier control points of a segment as rows over its control points.
  const WeightRows& to_bezier() const { return to_bezier_; }
  /// True if rows of positions sum to 1, so that control points transform as points.
  bool is_affine() const;
  /// Returns the knots of all segments as Bezier pieces, which share control points unless the curve jumps
  /// between them.
  Knots<double> knots_of_pieces() const;
  /// Returns the matrix that makes the control points of these pieces.
  SparseMatrix matrix_of_pieces() const;

  /// Appends, as bytes, the coefficients of the basis and the continuity at both ends of a segment.
  void append_type(std::string& bytes) const;
  void append_ends(Index face, std::string& bytes) const;

 private:
  int degree_;
  Index step_;
  WeightRows to_bezier_;
  std::vector<double> breaks_;
  Knots<double> bernstein_;
};

}  // namespace sublimit

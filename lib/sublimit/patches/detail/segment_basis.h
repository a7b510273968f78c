// SPDX-License-Identifier: Apache-2.0
#pragma once
// Piecewise polynomials in one variable whose pieces are all of one form: a segment takes degree + 1 control points,
// and the next one begins `step` points on. What a form is, is said by a matrix of powers of t in [0, 1]; rows are
// those of the Bezier piece that a segment is, its control points being blossoms of the powers.
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

class SegmentBasis {
 public:
  /// @param powers  (degree + 1)^2: row i has the coefficients of control point i, of t^0 first
  /// @param breaks  where segments meet, rising; one more than there are segments
  /// @throws InvalidParameter  another number of entries, a degree above `max_degree`, a step below 1, breaks that do
  ///                           not rise, numbers that are not finite
  SegmentBasis(int degree, Index step, std::span<const double> powers, std::vector<double> breaks);
  /// Catmull, Rom 1974: cubic pieces through all points but the first and the last.
  static SegmentBasis cardinal(std::vector<double> breaks);
  /// Control points are the coefficients of the powers themselves.
  static SegmentBasis taylor(int degree, std::vector<double> breaks);

  int degree() const { return degree_; }
  Index num_faces() const { return static_cast<Index>(breaks_.size()) - 1; }
  Index num_points() const { return step_ * (num_faces() - 1) + degree_ + 1; }
  /// First of the degree + 1 control points of a segment.
  Index first_point(Index face) const { return step_ * face; }

  /// Weights of a segment's control points: position, then derivatives per unit of t.
  /// @param rows  (order + 1) (degree + 1)
  void rows(double t, int order, std::span<double> rows) const;

  /// k of C^k, up to 2, where a segment meets the next one or the one before, -1 for a jump; 3 at the ends.
  int continuity(Index face, KnotSide end) const;

  const std::vector<double>& breaks() const { return breaks_; }
  double length(Index face) const { return breaks_[size_t(face) + 1] - breaks_[size_t(face)]; }
  /// @throws InvalidParameter  outside the domain
  KnotPlace<double> place(double t, KnotSide side) const;
  double parameter(const KnotPlace<double>& place) const;

  /// The Bezier control points of a segment as rows over its control points.
  const WeightRows& to_bezier() const { return to_bezier_; }
  /// True if control points are points: rows sum to 1.
  bool is_affine() const;
  /// All segments as Bezier pieces, which share their ends where they do not jump, and S.
  Knots<double> knots_of_pieces() const;
  SparseMatrix matrix_of_pieces() const;

  /// The matrix, as bytes, and continuity at both ends.
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

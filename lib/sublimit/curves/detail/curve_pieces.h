// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces of a limit curve. A piece is an edge long: from a point of a primal scheme to the next, from the middle of an
// edge to the next in a dual one. It depends on a window of points; its halves are the pieces 2j and 2j + 1 of the next
// level, and the block B_c of S between the windows takes one to the other:
//
//   p(s) = p_c(2s - c) B_c      p: row of weights over the window; c: 0 in the first half, 1 in the second
//
// Windows are of one type each: away from ends they are all the same, near an end one for each distance from it. Where
// the rows of a type are polynomials, which values at dyadic places tell, the way ends there; else at a vertex, which
// the digits of s reach. Towards a vertex or an end the block repeats, and its powers are taken.
//
// Derivatives double their rounding errors in a step and second ones quadruple them, unless these are free of constants
// and of linear functions: such rows are kept by their other weights alone, which give those of the first one or two
// unknowns.
#include <array>
#include <map>
#include <vector>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/detail/curve_polynomial.h"

namespace sublimit {

/// Consecutive points of a curve; of a closed one modulo its size.
struct PieceWindow {
  Index first = 0;
  Index size = 0;
};

/// Weights over the unknowns of a window, and their status.
struct CurvePieceRows {
  int exists = 0;               ///< derivatives at the place: 0, 1 or 2
  bool kink = false;            ///< they are those from behind: the curve has a corner inside the piece
  Index width = 0;              ///< unknowns of the window
  std::vector<double> weights;  ///< `width` each: position, first, second, as far as asked for and existing

  const double* row(int derivative) const { return weights.data() + derivative * width; }

 private:
  friend class CurvePieces;
  struct Step {
    int piece;
    int child;
    int power;  // -1: the block itself; m: its power 2^m
  };
  std::vector<Step> path;      // room that is used again
  std::vector<double> before;  // likewise
};

class CurvePieces {
 public:
  /// Computes all types that descents into these curves meet.
  /// @throws AnalysisError  no limit, masks that never settle, or that look further than they say
  CurvePieces(const CurveScheme<double>& scheme, int level, const std::vector<CurveOutline>& curves);

  const CurveLayout& layout() const { return layout_; }
  /// Piece j lies between the positions 2j and 2j + 2 (CurveLayout).
  Index num_pieces(const CurveOutline& curve) const {
    return curve.closed ? curve.size : static_cast<Index>(layout_.end(curve) / 2);
  }
  PieceWindow window(const CurveOutline& curve, Index piece) const;

  /// Rows at s in [0, 1] of a piece; derivatives per edge of the level.
  /// @param order      of derivatives that are wanted: 0, 1 or 2
  /// @param one_sided  at s = 0 and 1 those of the piece alone; else, at s = 0, those that it shares with the piece
  ///                   before. At s = 1 there are these alone.
  void rows(const CurveOutline& curve, Index piece, double s, int order, bool one_sided, CurvePieceRows& result) const;

  Index num_types() const { return static_cast<Index>(types_.size()); }
  /// Types that are polynomials.
  Index num_polynomial() const;

 private:
  using Real = CurvePolynomial::Real;
  using MatrixL = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowL = CurvePolynomial::Row;
  using Matrix = CurvePolynomial::Matrix;

  /// Limit and derivatives at a vertex.
  struct Vertex {
    int exists = -1;  // -1: nothing known
    Matrix rows;
  };
  struct Type {
    Index before = 0, after = 0;  // pieces on either side, `far_` for so many and more
    int level = 0;
    Index width = 0;
    std::array<int, 2> child{-1, -1};
    std::array<Matrix, 2> B;
    std::array<MatrixL, 2> exact_B;            // with row sums to more digits
    Eigen::VectorXd constant, linear;          // values of 1, and of x from the start of the piece in edges
    Eigen::VectorXd slope;                     // linear less its value at unknown 0, per that at unknown 1
    bool keeps_linear = true;                  // and so do its children
    std::array<RowL, 2> limit;                 // position at s = 0 and 1, where B_0 or B_1 repeats
    std::array<Vertex, 2> vertex;              // likewise, of types that are no polynomials
    std::vector<CurvePolynomial> polynomials;  // none, one, or one for each half
    int start_order = 2, middle_order = 2;     // derivatives where it meets the piece before, and where two halves meet
    std::array<std::vector<std::array<Matrix, 3>>, 2>
        powers;  // of the repeating blocks: by m, position and derivatives
  };

  Index clipped(Index pieces) const { return std::min(pieces, far_); }
  int find(Index before, Index after, int level) const;
  int add(Index before, Index after, int level);
  CurveOutline outline(Index pieces) const;
  CurveOutline canonical(const Type& type) const;
  Index canonical_piece(const Type& type) const { return type.before < far_ ? type.before : pad_; }
  int settled_level(int level) const;
  void make_blocks(int at);
  void make_limits(Type& type) const;
  RowL value(int at, Real s) const;
  void find_polynomials(int at);
  void find_orders(int at);
  void make_vertices(int at);
  void make_powers(Type& type) const;
  void project(const Type& type, int derivatives, double* weights) const;

  CurveScheme<double> scheme_;
  CurveLayout layout_;
  Index far_ = 0, pad_ = 0;
  int settled_ = 0;  // the level from which on masks stay the same
  std::vector<Type> types_;
  std::map<std::array<Index, 3>, int> numbers_;  // by pieces before and after, and level
  std::vector<int> first_types_;                 // of the first level, by pieces before and after
};

}  // namespace sublimit

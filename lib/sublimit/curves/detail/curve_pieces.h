// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces of a limit curve. A piece is an edge long: from a point of a primal scheme to the next, from the middle of an
// edge to the next in a dual one. It depends on a window of points; its halves are the pieces 2j and 2j + 1 of the next
// level, and the block B_c of S between the windows takes one to the other:
//
//   p(s) = p_c(2s - c) B_c      p: row of weights over the window; c: 0 in the first half, 1 in the second
//
// Windows with the same blocks are of one type: all windows away from ends, and near an end one type for each
// distance from it. The descent stops at a type whose rows are polynomials in s (decided from values at dyadic
// places), or at a vertex, which the binary digits of s reach. Towards a vertex or an end the same block
// repeats; its powers are stored.
//
// A step doubles the rounding errors of derivative rows and quadruples those of second ones, unless derivative
// rows vanish on constants, and second ones on linear functions. The first one or two weights of such rows are
// therefore computed from the others, such that they do.
#include <array>
#include <map>
#include <vector>

#include "sublimit/curves/detail/curve_levels.h"
#include "sublimit/curves/detail/curve_polynomial.h"
#include "sublimit/curves/detail/curve_vertex.h"

namespace sublimit {

/// Range of consecutive points of a curve, modulo its size if the curve is closed.
struct PieceWindow {
  Index first = 0;
  Index size = 0;
};

/// Result of CurvePieces::rows: weights over the unknowns of a window. Reuse it to avoid allocations.
struct CurvePieceRows {
  int exists = 0;               ///< highest derivative that exists at the place: 0, 1 or 2
  bool kink = false;            ///< true at a corner inside the piece: derivatives are those of the part behind it
  Index width = 0;              ///< number of unknowns of the window
  std::vector<double> weights;  ///< rows of `width` weights: position, first, second; as requested and existing

  const double* row(int derivative) const { return weights.data() + derivative * width; }

 private:
  friend class CurvePieces;
  struct Step {
    int piece;
    int child;
    int power;  // -1: the block itself; m: its power 2^m
  };
  std::vector<Step> path;      // memory that is reused
  std::vector<double> before;  // likewise
};

/// Types of the pieces of some curves, with their blocks, polynomials and powers. It never changes: threads may
/// share it.
class CurvePieces {
 public:
  /// Computes all types that a descent into these curves can reach.
  /// @throws AnalysisError  no limit; masks that never become stationary, or that reach further on some level
  ///                        than on level 0
  CurvePieces(const CurveScheme<double>& scheme, int level, const std::vector<CurveOutline>& curves);

  const CurveLayout& layout() const { return layout_; }
  /// Returns the number of pieces of a curve. Piece j lies between the positions 2j and 2j + 2 (CurveLayout).
  Index num_pieces(const CurveOutline& curve) const {
    return curve.closed ? curve.size : static_cast<Index>(layout_.end(curve) / 2);
  }
  /// Returns the points that a piece depends on.
  PieceWindow window(const CurveOutline& curve, Index piece) const;

  /// Computes the rows at s in [0, 1] of a piece. Derivatives are per edge of the level.
  /// @param order      highest derivative to compute: 0, 1 or 2
  /// @param one_sided  true: derivatives of this piece alone at s = 0. False: only those that agree with the
  ///                   piece before. At s = 1 derivatives are always one-sided.
  void rows(const CurveOutline& curve, Index piece, double s, int order, bool one_sided, CurvePieceRows& result) const;

  /// Returns the number of types.
  Index num_types() const { return static_cast<Index>(types_.size()); }
  /// Returns the number of types that consist of one or two polynomials.
  Index num_polynomial() const;

 private:
  using Real = CurvePolynomial::Real;
  using MatrixL = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowL = CurvePolynomial::Row;
  using Matrix = CurvePolynomial::Matrix;

  /// Limit and derivatives at a vertex.
  struct Vertex {
    int exists = -1;  // highest derivative that exists; -1: not computed
    Matrix rows;
  };
  struct Type {
    Index before = 0, after = 0;  // number of pieces on either side, at most `far_`
    int level = 0;
    Index width = 0;
    std::array<int, 2> child{-1, -1};
    std::array<Matrix, 2> B;
    std::array<MatrixL, 2> exact_B;            // B with row sums corrected in long double
    Eigen::VectorXd constant, linear;          // values of 1, and of x from the start of the piece in edges
    Eigen::VectorXd slope;                     // linear function with the values 0 and 1 at unknowns 0 and 1
    bool keeps_linear = true;                  // B and the blocks of all descendants reproduce linear functions
    std::array<RowL, 2> limit;                 // position at s = 0 and 1, where B_0 or B_1 repeats
    std::array<Vertex, 2> vertex;              // likewise with derivatives, for types without polynomials
    std::vector<CurvePolynomial> polynomials;  // none, one, or one for each half
    int start_order = 2, middle_order = 2;     // continuity with the piece before, and between two halves
    std::array<std::vector<std::array<Matrix, 3>>, 2>
        powers;  // [c][m][k]: B_c^(2^m) for derivative k, with the factors of the chain rule
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
  void find_orders(Type& type) const;
  CurveVertex vertex(const Type& type, int c) const;
  void make_vertices(Type& type) const;
  void make_powers(Type& type) const;
  void project(const Type& type, int derivatives, double* weights) const;
  void rows(int at, double s, int order, bool one_sided, CurvePieceRows& result) const;

  CurveScheme<double> scheme_;
  CurveLayout layout_;
  Index far_ = 0, pad_ = 0;
  int settled_ = 0;  // level from which on masks are stationary
  std::vector<Type> types_;
  std::map<std::array<Index, 3>, int> numbers_;  // type by pieces before, pieces after, and level
  std::vector<int> first_types_;                 // types of the first level, by pieces before and after
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves. Around a fixed point of refinement (a point or edge midpoint away from ends, or an end) a
// neighbourhood of points refines to itself by a local matrix A, read off S. The limit is the left eigenvector
// of A for eigenvalue 1, the derivative the one for 1/2 and the second derivative the one for 1/4, scaled by
// the parameters of the points. Every other position becomes a fixed point after some refinement steps; its
// rows are those of the fixed point times the S of these steps. Rows of non-stationary schemes are computed in
// the same way, from the level at which A stops changing.
#include <Eigen/Core>

#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/curves/detail/curve_levels.h"

namespace sublimit {

/// Kind of a fixed point of refinement, around which a local matrix is taken.
enum class CurveAnchor {
  inside,  ///< a point of a primal scheme, the middle of an edge of a dual one
  start,   ///< start of the limit of an open curve
  end,     ///< end of the limit of an open curve
};

/// Unknown that a row or column of a local matrix stands for.
struct CurveUnknown {
  std::int64_t position;  ///< distance from the anchor in half edges; at an end it counts into the curve
  int component = 0;      ///< 0 for the point, 1 for the derivative at it (Hermite schemes)

  bool is_point() const { return component == 0; }
};

/// Unknowns around an anchor that depend on no others: one refinement step takes their values x to A x.
struct CurveNeighborhood {
  std::vector<CurveUnknown> unknowns;  ///< unknowns of the rows and columns of A, by ascending position
  Eigen::MatrixXd A;
};

/// Limit and derivatives at some positions, as rows of weights over the unknowns of a level; a row per
/// position. Derivatives are per edge of the control polygon.
struct [[nodiscard]] CurveLimits {
  CurveMatrix<double> position, first,
      second;              ///< rows without entries where a derivative does not exist
  std::vector<int> order;  ///< per position: the highest derivative that exists, 0 to 2
};

/// Limits of a scheme's curves. Rows are computed on first use and cached. Threads may share it.
class CurveAnalysis {
 public:
  explicit CurveAnalysis(const CurveScheme<double>& scheme);

  /// Returns the local matrix of the step from `level` at an anchor.
  /// @param margin  half edges by which the neighbourhood is larger than the radius of the masks
  CurveNeighborhood neighborhood(CurveAnchor anchor, int level = 0, int margin = 0) const;

  /// Returns limits on one curve of a level, as rows over the unknowns of this curve.
  /// @param positions  in half edges of the level from the start of the limit (CurveLayout); positions beyond
  ///                   an open end count as the end
  /// @throws AnalysisError  no limit: eigenvalue 1 is not simple and dominant, or the masks never become
  ///                        stationary
  CurveLimits limits(const CurveOutline& curve, int level, const std::vector<std::int64_t>& positions) const;

  /// Returns the limits of all points of a level, curve by curve, as rows over the unknowns of the level.
  /// Points beyond the start or end of the limit (free ends) get its start or end.
  /// @throws AnalysisError     no limit, as above
  /// @throws InvalidParameter  a level that another scheme made
  CurveLimits limits(const CurveLevelOf<double>& level) const;

  const CurveLayout& layout() const { return layout_; }

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  /// Weights of the limit and its derivatives at one position. Unknowns are given by their offsets from a
  /// position inside, or are those of the whole canonical curve, counted from an end. Derivatives are per edge
  /// of the level; at an end their direction is into the curve.
  struct Rows {
    std::vector<CurveUnknown> unknowns;
    Vector position, first;
    Vector second[2];  ///< one-sided second derivatives, before and behind the position
    bool has_first = false, has_second[2] = {false, false};

    /// Returns the highest derivative that exists: 2 only if both one-sided second derivatives agree.
    int order() const {
      if (!has_first) return 0;
      if (!has_second[0] || !has_second[1]) return 1;
      const double scale = 1 + second[0].cwiseAbs().maxCoeff();
      return (second[0] - second[1]).cwiseAbs().maxCoeff() <= 1e-9 * scale ? 2 : 1;
    }
  };

  /// Returns the column of an unknown given by its offset from position `around` of a curve.
  Index column(const CurveOutline& curve, const CurveUnknown& unknown, std::int64_t around) const {
    return layout_.point(curve, around + unknown.position) * layout_.unknowns() + unknown.component;
  }
  /// Returns the index of unknown `i` when the curve is traversed backwards. Odd derivatives change sign: see `sign`.
  Index reversed(Index i) const {
    const Index component = i % layout_.unknowns();
    return component - (i - component);
  }
  /// Returns the factor of unknown `i` when the curve is traversed backwards: -1 for derivatives.
  double sign(Index i) const { return i % layout_.unknowns() == 0 ? 1 : -1; }

  /// Returns the unknowns of all points of a curve, by ascending position.
  std::vector<CurveUnknown> unknowns_of(const CurveOutline& curve) const;
  /// Returns the values that the unknowns have for the constant function 1.
  static Vector constant(const std::vector<CurveUnknown>& unknowns);
  /// Returns the values that the unknowns have for the function x, the position in edges.
  static Vector linear(const std::vector<CurveUnknown>& unknowns);

  /// Returns S of the canonical curve, an open curve so long that neither end influences the other or the
  /// middle.
  /// @param from_end  number the unknowns from the last point backwards, with the signs of derivatives (`sign`)
  const Matrix& canonical_matrix(int level, bool from_end) const;
  Matrix found_canonical_matrix(int level, bool from_end) const;

  /// Returns rows over the unknowns before a step, with derivatives per edge of that level.
  /// @param fine      rows over the unknowns after the step
  /// @param A         matrix of the step; its rows are the unknowns of `fine`
  /// @param unknowns  unknowns of the columns of A
  static Rows pulled_back(const Rows& fine, const Matrix& A, std::vector<CurveUnknown> unknowns);

  /// Returns the rows at an anchor of a level, in the unknowns of its neighbourhood.
  const Rows& rows_at_anchor(CurveAnchor anchor, int level) const;
  Rows found_rows_at_anchor(CurveAnchor anchor, int level) const;

  /// Returns the left eigenvectors of a local matrix for 1, 1/2 and 1/4, as far as the limit has derivatives.
  Rows eigen_rows(const CurveNeighborhood& n) const;

  /// Returns the indices of the unknowns between two positions and of all that these depend on, ascending.
  static std::vector<Index> closure(const CurveNeighborhood& n, std::int64_t from, std::int64_t to);

  /// Returns the number of eigenvalues with modulus >= `value`. The tolerance is 1e-6, since rounding moves a
  /// double eigenvalue by up to 1e-7.
  static int eigenvalues_from(const Matrix& A, double value);

  /// Computes a one-sided second derivative at an anchor. Hermite schemes have none here.
  /// @param side    0: before the anchor, 1: behind it; only unknowns that this side depends on get weights
  /// @param second  the result; of the size of `n`, zero on entry
  /// @return  false if the derivative does not exist or is not known
  bool second_derivative(const CurveNeighborhood& n, int side, Vector& second) const;

  /// Returns l with l^T A = value l^T and l^T scale = 1; nothing if there is none or more than one.
  static std::optional<Vector> left_eigenvector(const Matrix& A, double value, const Vector& scale);

  /// Returns the rows at a position away from ends.
  /// @param odd  the position is half an edge beside an anchor, not at one
  const Rows& rows_inside(int level, bool odd) const;

  /// Returns the rows over the canonical curve at a distance `position` from its start.
  /// @param reversed  from its end instead, with unknowns numbered from there
  const Rows& rows_near_end(int level, std::int64_t position, bool reversed) const;
  Rows found_rows_near_end(int level, std::int64_t position, bool reversed) const;

  /// Converts rows by offset from position `at` into rows by unknown of `curve`.
  Rows on_canonical(const Rows& rows, const CurveOutline& curve, std::int64_t at) const;
  /// Returns rows over the canonical curve of `level` at position `at`, from `rows` by offset at the same place
  /// of the next level (position 2 `at`).
  Rows one_step(int level, std::int64_t at, const Rows& rows) const;
  /// Converts rows by unknown of the canonical curve into rows by offset from position `at`; drops zero
  /// weights.
  Rows from_canonical(const Rows& rows, std::int64_t at) const;

  struct ByNear {
    int level;
    std::int64_t position;
    bool reversed;
    auto operator<=>(const ByNear&) const = default;
  };

  /// Half edges by which neighbourhoods exceed the radius: second differences out there identify the parabola.
  static constexpr int margin_ = 10;

  CurveScheme<double> scheme_;
  CurveLayout layout_;
  CurveOutline canonical_;
  // Computing a value never needs itself: matrices need no rows, rows at ends need the rows inside, and rows
  // beside an anchor need those of the next level.
  FoundByKey<std::pair<int, bool>, Matrix> canonical_matrices_;
  FoundByKey<std::pair<CurveAnchor, int>, Rows> anchor_rows_;
  FoundByKey<int, Rows> odd_rows_;
  FoundByKey<ByNear, Rows> end_rows_;
};

}  // namespace sublimit

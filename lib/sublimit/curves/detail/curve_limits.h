// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves. Around a fixed point of refinement (a point or edge midpoint away from ends, or an end) a
// neighbourhood of points refines to itself by a local matrix A, read off S: the limit is its left eigenvector for 1,
// the derivative the one for 1/2 and the second derivative the one for 1/4, scaled by the parameters of the points.
// Every other position gets there in some steps, and its rows are pulled back through the S of these steps; so are
// those of non-stationary schemes, whose A settles after some levels.
#include <Eigen/Core>

#include <optional>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/curves/curve_refine.h"

namespace sublimit {

/// Place of a local matrix on a curve.
enum class CurveAnchor {
  inside,  ///< a point of a primal scheme, the middle of an edge of a dual one
  start,   ///< the first end of the limit of an open curve
  end,     ///< the last one
};

/// A row or column of a local matrix.
struct CurveUnknown {
  std::int64_t position;  ///< in half edges from the anchor, inwards at an end
  int component = 0;      ///< 1: the derivative there, in a Hermite scheme

  bool is_point() const { return component == 0; }
};

/// A neighbourhood that refines to itself: x -> A x.
struct CurveNeighborhood {
  std::vector<CurveUnknown> unknowns;  ///< of the rows and columns of A, ascending
  Eigen::MatrixXd A;
};

/// Functionals of the points of a level: the limit and its derivatives at each of the requested positions.
struct [[nodiscard]] CurveLimits {
  CurveMatrix<double> position, first,
      second;              ///< derivatives per edge of the control polygon; empty rows if there is none
  std::vector<int> order;  ///< per row: the highest derivative that exists there, 0 to 2
};

/// Limits of a scheme's curves, each computed once, when it is first needed. Threads may share it.
class CurveAnalysis {
 public:
  explicit CurveAnalysis(const CurveScheme<double>& scheme);

  /// The local matrix at an anchor of a level.
  /// @param margin  half edges added to the radius that the masks ask for
  CurveNeighborhood neighborhood(CurveAnchor anchor, int level = 0, int margin = 0) const;

  /// Rows over the points of one curve of a level.
  /// @param positions  in half edges of the level from the start of the limit (CurveLayout); beyond an open end:
  ///                   the end
  /// @throws AnalysisError  no limit: eigenvalue 1 is not simple and dominant, or the masks never settle
  CurveLimits limits(const CurveOutline& curve, int level, const std::vector<std::int64_t>& positions) const;

  /// The limits of all points of a level, one curve after the other, over these points. Points beyond the start or end
  /// of the limit (free ends) get its start or end.
  CurveLimits limits(const CurveLevelOf<double>& level) const;

  const CurveLayout& layout() const { return layout_; }

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  /// Weights around a position inside (offsets from it), or over the whole canonical curve from an end on. Derivatives
  /// per edge of the level, inwards at an end.
  struct Rows {
    std::vector<CurveUnknown> unknowns;
    Vector position, first;
    Vector second[2];  ///< from before and from behind; one of them if they agree
    bool has_first = false, has_second[2] = {false, false};

    int order() const {
      if (!has_first) return 0;
      if (!has_second[0] || !has_second[1]) return 1;
      const double scale = 1 + second[0].cwiseAbs().maxCoeff();
      return (second[0] - second[1]).cwiseAbs().maxCoeff() <= 1e-9 * scale ? 2 : 1;
    }
  };

  /// Column of an unknown of a curve around a position.
  Index column(const CurveOutline& curve, const CurveUnknown& unknown, std::int64_t around) const {
    return layout_.point(curve, around + unknown.position) * layout_.unknowns() + unknown.component;
  }
  /// Returns the index of unknown `i` when the curve is traversed backwards. Odd derivatives change sign: see `sign`.
  Index reversed(Index i) const {
    const Index component = i % layout_.unknowns();
    return component - (i - component);
  }
  double sign(Index i) const { return i % layout_.unknowns() == 0 ? 1 : -1; }

  /// The unknowns of a curve's points, by position.
  std::vector<CurveUnknown> unknowns_of(const CurveOutline& curve) const;
  /// Points that are 1 everywhere, and points at their own positions, in edges.
  static Vector constant(const std::vector<CurveUnknown>& unknowns);
  static Vector linear(const std::vector<CurveUnknown>& unknowns);

  /// S of the canonical curve; seen from its other end if `from_end`.
  const Matrix& canonical_matrix(int level, bool from_end) const;
  Matrix found_canonical_matrix(int level, bool from_end) const;

  /// Rows pulled back through one step: A has their weights' points as rows.
  static Rows pulled_back(const Rows& fine, const Matrix& A, std::vector<CurveUnknown> unknowns);

  const Rows& rows_at_anchor(CurveAnchor anchor, int level) const;
  Rows found_rows_at_anchor(CurveAnchor anchor, int level) const;

  /// Left eigenvectors of a local matrix for 1, 1/2 and 1/4, as far as the limit has derivatives.
  Rows eigen_rows(const CurveNeighborhood& n) const;

  /// Points of a neighbourhood between two positions and those that they depend on, in order.
  static std::vector<Index> closure(const CurveNeighborhood& n, std::int64_t from, std::int64_t to);

  /// Eigenvalues that are no smaller than `value` in modulus; pairs that rounding has split lie within 1e-7 of their
  /// value.
  static int eigenvalues_from(const Matrix& A, double value);

  /// The second derivative seen from before (side 0) or behind: on the points that this side of the anchor depends on.
  bool second_derivative(const CurveNeighborhood& n, int side, Vector& second) const;

  /// l with l^T A = value l^T and l^T scale = 1, if it is unique.
  static std::optional<Vector> left_eigenvector(const Matrix& A, double value, const Vector& scale);

  /// Returns rows at a position away from ends: at an anchor, or (odd) half an edge beside one.
  const Rows& rows_inside(int level, bool odd) const;

  /// Over the points of the canonical curve, at a position so far from an end.
  const Rows& rows_near_end(int level, std::int64_t position, bool reversed) const;
  Rows found_rows_near_end(int level, std::int64_t position, bool reversed) const;

  /// Rows by offset as rows by point of the canonical curve.
  Rows on_canonical(const Rows& rows, const CurveOutline& curve, std::int64_t at) const;
  /// One step of the canonical curve, from `rows` at twice the position.
  Rows one_step(int level, std::int64_t at, const Rows& rows) const;
  /// Rows by point of the canonical curve as rows by offset.
  Rows from_canonical(const Rows& rows, std::int64_t at) const;

  struct ByNear {
    int level;
    std::int64_t position;
    bool reversed;
    auto operator<=>(const ByNear&) const = default;
  };

  /// Half edges of regular curve beyond the radius, by which parabolas are recognised.
  static constexpr int margin_ = 10;

  CurveScheme<double> scheme_;
  CurveLayout layout_;
  CurveOutline canonical_;
  // Matrices need nothing else, rows at anchors those inside, rows beside them those of later levels.
  FoundByKey<std::pair<int, bool>, Matrix> canonical_matrices_;
  FoundByKey<std::pair<CurveAnchor, int>, Rows> anchor_rows_;
  FoundByKey<int, Rows> odd_rows_;
  FoundByKey<ByNear, Rows> end_rows_;
};

}  // namespace sublimit

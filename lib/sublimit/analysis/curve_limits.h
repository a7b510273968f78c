// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves. Around a fixed point of refinement (a point or leg midpoint away from ends, or an end) a
// neighbourhood of points refines to itself by a local matrix A, read off S: the limit is its left eigenvector for 1,
// the derivative the one for 1/2 and the second derivative the one for 1/4, scaled by the parameters of the points.
// Every other position gets there in some steps, and its rows are pulled back through the S of these steps; so are
// those of non-stationary schemes, whose A settles after some levels.
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <map>
#include <optional>
#include <type_traits>

#include "sublimit/analysis/closed_set.h"
#include "sublimit/curve_refine.h"

namespace sublimit {

/// Where a local matrix lives.
enum class CurveAnchor {
  inside,  ///< a point of a primal scheme, the middle of a leg of a dual one
  start,   ///< the first end of the limit of an open curve
  end,     ///< the last one
};

/// A row or column of a local matrix.
struct CurveUnknown {
  std::int64_t position;  ///< in half legs from the anchor, inwards at an end
  int component = 0;      ///< 1: the derivative there, in a Hermite scheme

  bool is_point() const { return component == 0; }
};

/// A neighbourhood that refines to itself: x -> A x.
template <class T>
struct CurveNeighborhood {
  std::vector<CurveUnknown> unknowns;  ///< of the rows and columns of A, ascending
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> A;
};

/// Functionals of the points of a level: the limit and its derivatives at each of the requested positions.
template <class T>
struct CurveLimits {
  CurveMatrix<T> position, first, second;  ///< derivatives per leg of the control polygon; empty rows if there is none
  std::vector<int> order;                  ///< per row: the highest derivative that exists there, 0 to 2
};

template <class T>
class CurveAnalysis {
 public:
  explicit CurveAnalysis(const CurveScheme<T>& scheme) : scheme_(scheme), layout_(scheme) {
    // Long enough that neither end sees the other, nor the middle any end.
    canonical_ = layout_.control(4 * (layout_.radius() + layout_.end_points() + margin_), false);
  }

  /// The local matrix at an anchor of a level.
  /// @param margin  half legs added to the radius that the masks ask for
  CurveNeighborhood<T> neighborhood(CurveAnchor anchor, int level = 0, int margin = 0) {
    const Matrix& S = canonical_matrix(level, anchor == CurveAnchor::end);
    const CurveOutline child = layout_.child(canonical_);
    const std::int64_t at = anchor == CurveAnchor::inside ? 2 * (canonical_.size / 4) : 0;
    // All of the canonical curve that has its children in it, then what the points around the anchor depend on.
    CurveNeighborhood<T> all;
    std::vector<Index> points, children;
    for (Index a = 0; a < canonical_.size / 2; ++a) {
      const std::int64_t offset = layout_.position(canonical_, a) - at;
      const Index child_point = layout_.point(child, offset + 2 * at);  // the same way from twice the anchor
      for (int component = 0; component < layout_.unknowns(); ++component) {
        all.unknowns.push_back({offset, component});
        points.push_back(a * layout_.unknowns() + component);
        children.push_back(child_point * layout_.unknowns() + component);
      }
    }
    all.A = S(children, points);
    const std::vector<Index> kept = closure(all, -layout_.radius() - margin, layout_.radius() + margin);
    CurveNeighborhood<T> result;
    for (const Index i : kept) result.unknowns.push_back(all.unknowns[i]);
    result.A = all.A(kept, kept);
    return result;
  }

  /// Rows over the points of one curve of a level.
  /// @param positions  in half legs of the level from the start of the limit (CurveLayout); beyond an open end: the end
  /// @throws AnalysisError  no limit: eigenvalue 1 is not simple and dominant, or the masks never settle
  CurveLimits<T> limits(const CurveOutline& curve, int level, const std::vector<std::int64_t>& positions) {
    if (!curve.closed && curve.size < canonical_.size) {  // too short for ends that do not see each other: refine
      std::vector<std::int64_t> doubled;
      for (const std::int64_t p : positions) doubled.push_back(2 * p);
      CurveLimits<T> fine = limits(layout_.child(curve), level + 1, doubled);
      const CurveMatrix<T> S = curve_matrix(scheme_, {curve}, level);
      fine.position = CurveMatrix<T>(fine.position * S);
      fine.first = CurveMatrix<T>(fine.first * S);
      fine.second = CurveMatrix<T>(fine.second * S);
      return fine;
    }
    const Index count = static_cast<Index>(positions.size()), size = curve.size * layout_.unknowns();
    CurveRows<T> position(count, size), first(count, size), second(count, size);
    CurveLimits<T> result;
    T legs(1);  // of this level in one of the control polygon
    for (int k = 0; k < level; ++k) legs *= T(2);
    for (const std::int64_t p : positions) {
      const std::int64_t end = curve.closed ? 0 : layout_.end(curve);
      const bool near_start = !curve.closed && p - layout_.radius() < layout_.begin();
      const bool near_end = !curve.closed && !near_start && end - p - layout_.radius() < layout_.begin();
      const Rows& rows = near_start ? rows_near_end(level, p, false)
                         : near_end ? rows_near_end(level, end - p, true)
                                    : rows_inside(level, p % 2 != 0);
      const auto terms = [&](const Vector& weights, const T& factor) {
        std::vector<std::pair<Index, T>> row;
        for (Eigen::Index i = 0; i < weights.size(); ++i) {
          if (weights[i] == T(0)) continue;
          if (near_end)
            row.push_back({size - layout_.unknowns() + reversed(Index(i)), sign(Index(i)) * factor * weights[i]});
          else
            row.push_back({near_start ? Index(i) : column(curve, rows.unknowns[i], p), factor * weights[i]});
        }
        return row;
      };
      const T inwards = near_end ? -legs : legs;
      position.append(terms(rows.position, T(1)));
      first.append(terms(rows.first, inwards));
      result.order.push_back(rows.order());
      second.append(result.order.back() < 2 ? std::vector<std::pair<Index, T>>{} : terms(rows.second[0], legs * legs));
    }
    result.position = position.finish();
    result.first = first.finish();
    result.second = second.finish();
    return result;
  }

  /// The limits of all points of a level, one curve after the other, over these points. Points beyond the start or end
  /// of the limit (free ends) get its start or end.
  CurveLimits<T> limits(const CurveLevelOf<T>& level) {
    const Index columns = level.num_points() * level.unknowns;
    CurveRows<T> rows[] = {{level.num_points(), columns}, {level.num_points(), columns}, {level.num_points(), columns}};
    CurveLimits<T> result;
    Index start = 0;
    for (const CurveOutline& curve : level.curves) {
      std::vector<std::int64_t> positions;
      for (Index a = 0; a < curve.size; ++a) positions.push_back(layout_.position(curve, a));
      const CurveLimits<T> one = limits(curve, level.number, positions);
      const CurveMatrix<T>* parts[] = {&one.position, &one.first, &one.second};
      for (int i = 0; i < 3; ++i)
        for (Index a = 0; a < curve.size; ++a) {
          std::vector<std::pair<Index, T>> row;
          for (typename CurveMatrix<T>::InnerIterator it(*parts[i], a); it; ++it)
            row.push_back({start + static_cast<Index>(it.col()), it.value()});
          rows[i].append(row);
        }
      result.order.insert(result.order.end(), one.order.begin(), one.order.end());
      start += curve.size * level.unknowns;
    }
    result.position = rows[0].finish();
    result.first = rows[1].finish();
    result.second = rows[2].finish();
    return result;
  }

  const CurveLayout& layout() const { return layout_; }

 private:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// Weights around a position inside (offsets from it), or over the whole canonical curve from an end on. Derivatives per leg
  /// of the level, inwards at an end.
  struct Rows {
    std::vector<CurveUnknown> unknowns;
    Vector position, first;
    Vector second[2];  ///< from before and from behind; one of them if they agree
    bool has_first = false, has_second[2] = {false, false};

    int order() const {
      if (!has_first) return 0;
      if (!has_second[0] || !has_second[1]) return 1;
      const T scale = T(1) + second[0].cwiseAbs().maxCoeff();
      return (second[0] - second[1]).cwiseAbs().maxCoeff() <= T(1e-9) * scale ? 2 : 1;
    }
  };

  /// Column of an unknown of a curve around a position.
  Index column(const CurveOutline& curve, const CurveUnknown& unknown, std::int64_t around) const {
    return layout_.point(curve, around + unknown.position) * layout_.unknowns() + unknown.component;
  }
  /// Of unknown i counted from one end the index from the other end's unknowns on, and its sign: derivatives turn.
  Index reversed(Index i) const {
    const Index component = i % layout_.unknowns();
    return component - (i - component);
  }
  T sign(Index i) const { return i % layout_.unknowns() == 0 ? T(1) : T(-1); }

  /// The unknowns of a curve's points, by position.
  std::vector<CurveUnknown> unknowns_of(const CurveOutline& curve) const {
    std::vector<CurveUnknown> unknowns;
    for (Index a = 0; a < curve.size; ++a)
      for (int component = 0; component < layout_.unknowns(); ++component)
        unknowns.push_back({layout_.position(curve, a), component});
    return unknowns;
  }
  /// Points that are 1 everywhere, and points at their own positions, in legs.
  static Vector constant(const std::vector<CurveUnknown>& unknowns) {
    Vector one(unknowns.size());
    for (Eigen::Index i = 0; i < one.size(); ++i) one[i] = T(unknowns[i].is_point() ? 1 : 0);
    return one;
  }
  static Vector linear(const std::vector<CurveUnknown>& unknowns) {
    Vector x(unknowns.size());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] = unknowns[i].is_point() ? T(static_cast<int>(unknowns[i].position)) / T(2) : T(1);
    return x;
  }

  /// S of the canonical curve; seen from its other end if `from_end`.
  const Matrix& canonical_matrix(int level, bool from_end) {
    const auto at = canonical_matrices_.find({level, from_end});
    if (at != canonical_matrices_.end()) return at->second;
    Matrix S(curve_matrix(scheme_, {canonical_}, level));
    if (from_end) {
      const auto turned = [&](Eigen::Index size) {
        std::vector<Index> order;
        for (Index i = 0; i < size; ++i) order.push_back(static_cast<Index>(size) - layout_.unknowns() + reversed(i));
        return order;
      };
      S = Matrix(S(turned(S.rows()), turned(S.cols())));
      for (Eigen::Index i = 0; i < S.rows(); ++i)
        for (Eigen::Index j = 0; j < S.cols(); ++j) S(i, j) *= sign(Index(i)) * sign(Index(j));
    }
    return canonical_matrices_[{level, from_end}] = S;
  }

  /// Rows pulled back through one step: A has their weights' points as rows.
  static Rows pulled_back(const Rows& fine, const Matrix& A, std::vector<CurveUnknown> unknowns) {
    Rows rows = fine;
    rows.unknowns = std::move(unknowns);
    rows.position = A.transpose() * fine.position;
    rows.first = T(2) * (A.transpose() * fine.first);
    // Derivatives see no constants, and second ones nothing linear. Rounding would let these grow by 2 and 4 a step.
    const Vector one = constant(rows.unknowns), x = linear(rows.unknowns);
    rows.first -= rows.first.dot(one) * rows.position;
    if (rows.has_first) rows.first /= rows.first.dot(x);
    for (int side : {0, 1}) {
      rows.second[side] = T(4) * (A.transpose() * fine.second[side]);
      rows.second[side] -= rows.second[side].dot(one) * rows.position;
      if (rows.has_first) rows.second[side] -= rows.second[side].dot(x) * rows.first;
    }
    return rows;
  }

  const Rows& rows_at_anchor(CurveAnchor anchor, int level) {
    const auto known = anchor_rows_.find({anchor, level});
    if (known != anchor_rows_.end()) return known->second;
    std::vector<CurveNeighborhood<T>> steps{neighborhood(anchor, level, margin_)};
    for (int k = level + 1;; ++k) {
      CurveNeighborhood<T> next = neighborhood(anchor, k, margin_);
      const bool settled = (next.A - steps.back().A).cwiseAbs().maxCoeff() <= std::numeric_limits<T>::epsilon();
      if (settled) break;
      if (k > level + 2000) throw AnalysisError(scheme_.name + ": the masks do not settle");
      steps.push_back(std::move(next));
    }
    Rows rows = eigen_rows(steps.back());
    if (anchor != CurveAnchor::inside && !rows_at_anchor(CurveAnchor::inside, level).has_second[0])
      rows.has_second[0] = rows.has_second[1] = false;  // a Taylor polynomial, but no derivative around the end
    for (size_t i = steps.size() - 1; i-- > 0;) rows = pulled_back(rows, steps[i].A, steps[i].unknowns);
    return anchor_rows_[{anchor, level}] = rows;
  }

  /// Left eigenvectors of a local matrix for 1, 1/2 and 1/4, as far as the limit has derivatives.
  Rows eigen_rows(const CurveNeighborhood<T>& n) const {
    Rows rows;
    rows.unknowns = n.unknowns;
    rows.position = rows.first = rows.second[0] = rows.second[1] = Vector::Zero(n.A.rows());
    const std::vector<Index> points = closure(n, -layout_.radius(), layout_.radius());
    const Matrix A = n.A(points, points);
    const Eigen::Index size = A.rows();
    std::vector<CurveUnknown> unknowns;
    for (const Index i : points) unknowns.push_back(n.unknowns[i]);
    std::optional<Vector> position = left_eigenvector(A, T(1), constant(unknowns));
    if (!position || eigenvalues_from(A, 1) != 1)
      throw AnalysisError(scheme_.name + ": eigenvalue 1 of a local matrix is not simple and dominant");
    const std::optional<Vector> first = left_eigenvector(A, T(1) / T(2), linear(unknowns));
    rows.has_first = first && eigenvalues_from(A, 0.5) == 2;
    for (Eigen::Index i = 0; i < size; ++i) {
      // A point that stays is its own limit, to the last bit.
      if (unknowns[i].position == 0 && unknowns[i].is_point() && A.row(i) == Vector::Unit(size, i).transpose())
        position = Vector::Unit(size, i);
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      rows.position[points[i]] = (*position)[i];
      if (rows.has_first) rows.first[points[i]] = (*first)[i];
    }
    for (int side : {0, 1}) rows.has_second[side] = rows.has_first && second_derivative(n, side, rows.second[side]);
    return rows;
  }

  /// Points of a neighbourhood between two positions and those that they depend on, in order.
  static std::vector<Index> closure(const CurveNeighborhood<T>& n, std::int64_t from, std::int64_t to) {
    std::vector<Index> between;
    for (size_t i = 0; i < n.unknowns.size(); ++i)
      if (n.unknowns[i].position >= from && n.unknowns[i].position <= to) between.push_back(static_cast<Index>(i));
    return closed_set(n.A, between);
  }

  /// Eigenvalues that are no smaller than `value` in modulus; pairs that rounding has split lie within 1e-7 of their
  /// value.
  static int eigenvalues_from(const Matrix& A, double value) {
    Eigen::MatrixXd rounded(A.rows(), A.cols());
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j < A.cols(); ++j) rounded(i, j) = static_cast<double>(A(i, j));
    return static_cast<int>((rounded.eigenvalues().cwiseAbs().array() >= value * (1 - 1e-6)).count());
  }

  /// The second derivative seen from before (side 0) or behind: on the points that this side of the anchor depends on.
  bool second_derivative(const CurveNeighborhood<T>& n, int side, Vector& second) const {
    if (layout_.unknowns() > 1) return false;  // not looked for
    const std::int64_t far = n.unknowns.back().position;
    const bool at_end = n.unknowns.front().position > -far / 2;
    std::vector<Index> points = closure(n, side == 0 || at_end ? -far : 0, side == 0 && !at_end ? 0 : far);
    if (side == 0 && !at_end) std::reverse(points.begin(), points.end());  // away from the anchor
    const Matrix A = n.A(points, points);
    const Eigen::Index size = A.rows();
    const int large = eigenvalues_from(A, 0.25);
    if (large == 2) return true;  // straight to second order, whatever the points
    if (large != 3 || size < 5) return false;
    // The points whose limit is half the square of the parameter: far from the anchor their second difference is 1.
    const auto difference = [&](Eigen::Index from_last) {
      Vector weights = Vector::Zero(size);
      weights[size - 3 - from_last] = weights[size - 1 - from_last] = T(1);
      weights[size - 2 - from_last] = T(-2);
      return weights;
    };
    const std::optional<Vector> parabola = left_eigenvector(A.transpose(), T(1) / T(4), difference(0));
    if (!parabola) return false;
    for (Eigen::Index i : {1, 2})
      if (const T error = difference(i).dot(*parabola) - T(1); error > T(1e-9) || error < T(-1e-9)) return false;
    // Weights are within the radius alone.
    const std::int64_t radius = layout_.radius();
    const std::vector<Index> near = closure(n, side == 0 || at_end ? -radius : 0, side == 0 && !at_end ? 0 : radius);
    Vector scale(near.size());
    for (size_t i = 0; i < near.size(); ++i)
      scale[Eigen::Index(i)] = (*parabola)[std::find(points.begin(), points.end(), near[i]) - points.begin()];
    const std::optional<Vector> row = left_eigenvector(n.A(near, near), T(1) / T(4), scale);
    if (!row) return false;
    for (size_t i = 0; i < near.size(); ++i) second[near[i]] = (*row)[Eigen::Index(i)];
    return true;
  }

  /// l with l^T A = value l^T and l^T scale = 1, if it is unique.
  static std::optional<Vector> left_eigenvector(const Matrix& A, const T& value, const Vector& scale) {
    const Eigen::Index size = A.rows();
    Matrix equations(size + 1, size);
    equations.topRows(size) = A.transpose() - value * Matrix::Identity(size, size);
    equations.row(size) = scale.transpose();
    Vector right = Vector::Zero(size + 1);
    right[size] = T(1);
    const Eigen::ColPivHouseholderQR<Matrix> qr(equations);
    Vector l = qr.solve(right);
    const auto rest_of = [&] {  // residuals in more digits, so that refining the solution gives it all of its own
      Vector rest(size + 1);
      for (Eigen::Index i = 0; i <= size; ++i) {
        using Longer = std::conditional_t<std::is_same_v<T, double>, long double, T>;
        Longer sum = Longer(right[i]);
        for (Eigen::Index j = 0; j < size; ++j) sum -= Longer(equations(i, j)) * Longer(l[j]);
        rest[i] = static_cast<T>(sum);
      }
      return rest;
    };
    for (int i = 0; i < 2; ++i) l += qr.solve(rest_of());
    const Vector rest = rest_of();
    if (qr.rank() < size || rest.cwiseAbs().maxCoeff() > T(1e-10)) return std::nullopt;
    const T least = std::numeric_limits<T>::epsilon() * l.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < size; ++i)
      if (l[i] < least && l[i] > -least) l[i] = T(0);
    return l;
  }

  /// At a position away from ends: at an anchor, or (odd) half a leg beside one.
  const Rows& rows_inside(int level, bool odd) {
    if (!odd) return rows_at_anchor(CurveAnchor::inside, level);
    const auto known = odd_rows_.find(level);
    if (known != odd_rows_.end()) return known->second;
    const std::int64_t at = 2 * (canonical_.size / 4) + 1;
    return odd_rows_[level] = from_canonical(one_step(level, at, rows_at_anchor(CurveAnchor::inside, level + 1)), at);
  }

  /// Over the points of the canonical curve, at a position so far from an end.
  const Rows& rows_near_end(int level, std::int64_t position, bool reversed) {
    if (position < 0) position = 0;
    const auto known = end_rows_.find({level, position, reversed});
    if (known != end_rows_.end()) return known->second;
    Rows rows;
    if (position == 0) {
      rows = on_canonical(rows_at_anchor(reversed ? CurveAnchor::end : CurveAnchor::start, level), canonical_, 0);
    } else if (position - layout_.radius() >= layout_.begin()) {
      rows = on_canonical(rows_inside(level, position % 2 != 0), canonical_, position);
    } else {
      const Rows fine = rows_near_end(level + 1, 2 * position, reversed);
      rows = pulled_back(fine, canonical_matrix(level, reversed).topRows(canonical_.size * layout_.unknowns()),
                         unknowns_of(canonical_));
    }
    return end_rows_[{level, position, reversed}] = rows;
  }

  /// Rows by offset as rows by point of the canonical curve.
  Rows on_canonical(const Rows& rows, const CurveOutline& curve, std::int64_t at) const {
    Rows result = rows;
    result.unknowns = unknowns_of(curve);
    result.position = result.first = result.second[0] = result.second[1] =
        Vector::Zero(curve.size * layout_.unknowns());
    for (size_t i = 0; i < rows.unknowns.size(); ++i) {
      const Eigen::Index row = Eigen::Index(i);
      if (rows.position[row] == T(0) && rows.first[row] == T(0) && rows.second[0][row] == T(0) &&
          rows.second[1][row] == T(0))
        continue;
      const Index a = column(curve, rows.unknowns[i], at);
      result.position[a] = rows.position[i];
      result.first[a] = rows.first[i];
      for (int side : {0, 1}) result.second[side][a] = rows.second[side][Eigen::Index(i)];
    }
    return result;
  }
  /// One step of the canonical curve, from `rows` at twice the position.
  Rows one_step(int level, std::int64_t at, const Rows& rows) {
    const CurveOutline child = layout_.child(canonical_);
    return pulled_back(on_canonical(rows, child, 2 * at), canonical_matrix(level, false), unknowns_of(canonical_));
  }
  /// Rows by point of the canonical curve as rows by offset.
  Rows from_canonical(const Rows& rows, std::int64_t at) const {
    Rows result = rows;
    result.unknowns.clear();
    std::vector<Index> kept;
    for (Index a = 0; a < Index(rows.unknowns.size()); ++a)
      if (rows.position[a] != T(0) || rows.first[a] != T(0) || rows.second[0][a] != T(0) || rows.second[1][a] != T(0)) {
        kept.push_back(a);
        result.unknowns.push_back({rows.unknowns[a].position - at, rows.unknowns[a].component});
      }
    result.position = rows.position(kept);
    result.first = rows.first(kept);
    for (int side : {0, 1}) result.second[side] = rows.second[side](kept);
    return result;
  }

  struct ByNear {
    int level;
    std::int64_t position;
    bool reversed;
    auto operator<=>(const ByNear&) const = default;
  };

  /// Half legs of regular curve beyond the radius, to tell what a parabola is.
  static constexpr int margin_ = 10;

  CurveScheme<T> scheme_;
  CurveLayout layout_;
  CurveOutline canonical_;
  std::map<std::pair<int, bool>, Matrix> canonical_matrices_;
  std::map<std::pair<CurveAnchor, int>, Rows> anchor_rows_;
  std::map<int, Rows> odd_rows_;
  std::map<ByNear, Rows> end_rows_;
};

}  // namespace sublimit

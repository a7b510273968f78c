// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/detail/curve_limits.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/neighborhood/closed_set.h"

namespace sublimit {

CurveAnalysis::CurveAnalysis(const CurveScheme<double>& scheme) : scheme_(scheme), layout_(scheme) {
  // Long enough that neither end sees the other, nor the middle any end.
  canonical_ = layout_.control(4 * (layout_.radius() + layout_.end_points() + margin_), false);
}

CurveNeighborhood CurveAnalysis::neighborhood(CurveAnchor anchor, int level, int margin) const {
  const Matrix& S = canonical_matrix(level, anchor == CurveAnchor::end);
  const CurveOutline child = layout_.child(canonical_);
  const std::int64_t at = anchor == CurveAnchor::inside ? 2 * (canonical_.size / 4) : 0;
  // All of the canonical curve that has its children in it, then what the points around the anchor depend on.
  CurveNeighborhood all;
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
  CurveNeighborhood result;
  for (const Index i : kept) result.unknowns.push_back(all.unknowns[i]);
  result.A = all.A(kept, kept);
  return result;
}

CurveLimits CurveAnalysis::limits(const CurveOutline& curve, int level,
                                  const std::vector<std::int64_t>& positions) const {
  if (!curve.closed && curve.size < canonical_.size) {  // too short for ends that do not see each other: refine
    std::vector<std::int64_t> doubled;
    for (const std::int64_t p : positions) doubled.push_back(2 * p);
    CurveLimits fine = limits(layout_.child(curve), level + 1, doubled);
    const CurveMatrix<double> S = curve_matrix(scheme_, {curve}, level);
    fine.position = CurveMatrix<double>(fine.position * S);
    fine.first = CurveMatrix<double>(fine.first * S);
    fine.second = CurveMatrix<double>(fine.second * S);
    return fine;
  }
  const Index count = static_cast<Index>(positions.size()), size = curve.size * layout_.unknowns();
  CurveRows<double> position(count, size), first(count, size), second(count, size);
  CurveLimits result;
  double edges = 1;  // of this level in one of the control polygon
  for (int k = 0; k < level; ++k) edges *= 2;
  for (const std::int64_t p : positions) {
    const std::int64_t end = curve.closed ? 0 : layout_.end(curve);
    const bool near_start = !curve.closed && p - layout_.radius() < layout_.begin();
    const bool near_end = !curve.closed && !near_start && end - p - layout_.radius() < layout_.begin();
    const Rows& rows = near_start ? rows_near_end(level, p, false)
                       : near_end ? rows_near_end(level, end - p, true)
                                  : rows_inside(level, p % 2 != 0);
    const auto terms = [&](const Vector& weights, double factor) {
      std::vector<std::pair<Index, double>> row;
      for (Eigen::Index i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        if (near_end)
          row.push_back({size - layout_.unknowns() + reversed(Index(i)), sign(Index(i)) * factor * weights[i]});
        else
          row.push_back({near_start ? Index(i) : column(curve, rows.unknowns[i], p), factor * weights[i]});
      }
      return row;
    };
    const double inwards = near_end ? -edges : edges;
    position.append(terms(rows.position, 1));
    first.append(terms(rows.first, inwards));
    result.order.push_back(rows.order());
    second.append(result.order.back() < 2 ? std::vector<std::pair<Index, double>>{}
                                          : terms(rows.second[0], edges * edges));
  }
  result.position = position.finish();
  result.first = first.finish();
  result.second = second.finish();
  return result;
}

CurveLimits CurveAnalysis::limits(const CurveLevelOf<double>& level) const {
  check_made_by(level, scheme_, "the analysis of limits (CurveAnalysis)");
  const Index columns = level.num_points() * level.unknowns;
  CurveRows<double> rows[] = {
      {level.num_points(), columns}, {level.num_points(), columns}, {level.num_points(), columns}};
  CurveLimits result;
  Index start = 0;
  for (const CurveOutline& curve : level.curves) {
    std::vector<std::int64_t> positions;
    for (Index a = 0; a < curve.size; ++a) positions.push_back(layout_.position(curve, a));
    const CurveLimits one = limits(curve, level.number, positions);
    const CurveMatrix<double>* parts[] = {&one.position, &one.first, &one.second};
    for (int i = 0; i < 3; ++i)
      for (Index a = 0; a < curve.size; ++a) {
        std::vector<std::pair<Index, double>> row;
        for (CurveMatrix<double>::InnerIterator it(*parts[i], a); it; ++it)
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

std::vector<CurveUnknown> CurveAnalysis::unknowns_of(const CurveOutline& curve) const {
  std::vector<CurveUnknown> unknowns;
  for (Index a = 0; a < curve.size; ++a)
    for (int component = 0; component < layout_.unknowns(); ++component)
      unknowns.push_back({layout_.position(curve, a), component});
  return unknowns;
}

Eigen::VectorXd CurveAnalysis::constant(const std::vector<CurveUnknown>& unknowns) {
  Vector one(unknowns.size());
  for (Eigen::Index i = 0; i < one.size(); ++i) one[i] = unknowns[i].is_point() ? 1 : 0;
  return one;
}

Eigen::VectorXd CurveAnalysis::linear(const std::vector<CurveUnknown>& unknowns) {
  Vector x(unknowns.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = unknowns[i].is_point() ? double(unknowns[i].position) / 2 : 1;
  return x;
}

const Eigen::MatrixXd& CurveAnalysis::canonical_matrix(int level, bool from_end) const {
  return canonical_matrices_.get({level, from_end}, [&] { return found_canonical_matrix(level, from_end); });
}

Eigen::MatrixXd CurveAnalysis::found_canonical_matrix(int level, bool from_end) const {
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
  return S;
}

CurveAnalysis::Rows CurveAnalysis::pulled_back(const Rows& fine, const Matrix& A, std::vector<CurveUnknown> unknowns) {
  Rows rows = fine;
  rows.unknowns = std::move(unknowns);
  rows.position = A.transpose() * fine.position;
  rows.first = 2 * (A.transpose() * fine.first);
  // Derivatives see no constants, and second ones nothing linear. Rounding would let these grow by 2 and 4 a step.
  const Vector one = constant(rows.unknowns), x = linear(rows.unknowns);
  rows.first -= rows.first.dot(one) * rows.position;
  if (rows.has_first) rows.first /= rows.first.dot(x);
  for (int side : {0, 1}) {
    rows.second[side] = 4 * (A.transpose() * fine.second[side]);
    rows.second[side] -= rows.second[side].dot(one) * rows.position;
    if (rows.has_first) rows.second[side] -= rows.second[side].dot(x) * rows.first;
  }
  return rows;
}

const CurveAnalysis::Rows& CurveAnalysis::rows_at_anchor(CurveAnchor anchor, int level) const {
  return anchor_rows_.get({anchor, level}, [&] { return found_rows_at_anchor(anchor, level); });
}

CurveAnalysis::Rows CurveAnalysis::found_rows_at_anchor(CurveAnchor anchor, int level) const {
  std::vector<CurveNeighborhood> steps{neighborhood(anchor, level, margin_)};
  for (int k = level + 1;; ++k) {
    CurveNeighborhood next = neighborhood(anchor, k, margin_);
    const bool settled = (next.A - steps.back().A).cwiseAbs().maxCoeff() <= std::numeric_limits<double>::epsilon();
    if (settled) break;
    if (k > level + 2000) throw AnalysisError(scheme_.name + ": the masks do not settle");
    steps.push_back(std::move(next));
  }
  Rows rows = eigen_rows(steps.back());
  if (anchor != CurveAnchor::inside && !rows_at_anchor(CurveAnchor::inside, level).has_second[0])
    rows.has_second[0] = rows.has_second[1] = false;  // a Taylor polynomial, but no derivative around the end
  for (size_t i = steps.size() - 1; i-- > 0;) rows = pulled_back(rows, steps[i].A, steps[i].unknowns);
  return rows;
}

CurveAnalysis::Rows CurveAnalysis::eigen_rows(const CurveNeighborhood& n) const {
  Rows rows;
  rows.unknowns = n.unknowns;
  rows.position = rows.first = rows.second[0] = rows.second[1] = Vector::Zero(n.A.rows());
  const std::vector<Index> points = closure(n, -layout_.radius(), layout_.radius());
  const Matrix A = n.A(points, points);
  const Eigen::Index size = A.rows();
  std::vector<CurveUnknown> unknowns;
  for (const Index i : points) unknowns.push_back(n.unknowns[i]);
  std::optional<Vector> position = left_eigenvector(A, 1, constant(unknowns));
  if (!position || eigenvalues_from(A, 1) != 1)
    throw AnalysisError(scheme_.name + ": eigenvalue 1 of a local matrix is not simple and dominant");
  const std::optional<Vector> first = left_eigenvector(A, 1.0 / 2, linear(unknowns));
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

std::vector<Index> CurveAnalysis::closure(const CurveNeighborhood& n, std::int64_t from, std::int64_t to) {
  std::vector<Index> between;
  for (size_t i = 0; i < n.unknowns.size(); ++i)
    if (n.unknowns[i].position >= from && n.unknowns[i].position <= to) between.push_back(static_cast<Index>(i));
  return closed_set(n.A, between);
}

int CurveAnalysis::eigenvalues_from(const Matrix& A, double value) {
  return static_cast<int>((eigenvalues(A).cwiseAbs().array() >= value * (1 - 1e-6)).count());
}

bool CurveAnalysis::second_derivative(const CurveNeighborhood& n, int side, Vector& second) const {
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
    weights[size - 3 - from_last] = weights[size - 1 - from_last] = 1;
    weights[size - 2 - from_last] = -2;
    return weights;
  };
  const std::optional<Vector> parabola = left_eigenvector(A.transpose(), 1.0 / 4, difference(0));
  if (!parabola) return false;
  for (Eigen::Index i : {1, 2})
    if (const double error = difference(i).dot(*parabola) - 1; error > 1e-9 || error < -1e-9) return false;
  // Weights are within the radius alone.
  const std::int64_t radius = layout_.radius();
  const std::vector<Index> near = closure(n, side == 0 || at_end ? -radius : 0, side == 0 && !at_end ? 0 : radius);
  Vector scale(near.size());
  for (size_t i = 0; i < near.size(); ++i)
    scale[Eigen::Index(i)] = (*parabola)[std::find(points.begin(), points.end(), near[i]) - points.begin()];
  const std::optional<Vector> row = left_eigenvector(n.A(near, near), 1.0 / 4, scale);
  if (!row) return false;
  for (size_t i = 0; i < near.size(); ++i) second[near[i]] = (*row)[Eigen::Index(i)];
  return true;
}

std::optional<Eigen::VectorXd> CurveAnalysis::left_eigenvector(const Matrix& A, double value, const Vector& scale) {
  const Eigen::Index size = A.rows();
  Matrix equations(size + 1, size);
  equations.topRows(size) = A.transpose() - value * Matrix::Identity(size, size);
  equations.row(size) = scale.transpose();
  Vector right = Vector::Zero(size + 1);
  right[size] = 1;
  const PivotedQr qr(equations);
  Vector l = qr.solve(right);
  const auto rest_of = [&] {  // residuals in more digits, so that refining the solution gives it all of its own
    Vector rest(size + 1);
    for (Eigen::Index i = 0; i <= size; ++i) {
      long double sum = right[i];
      for (Eigen::Index j = 0; j < size; ++j) sum -= static_cast<long double>(equations(i, j)) * l[j];
      rest[i] = static_cast<double>(sum);
    }
    return rest;
  };
  for (int i = 0; i < 2; ++i) l += qr.solve(rest_of());
  const Vector rest = rest_of();
  if (qr.rank() < size || rest.cwiseAbs().maxCoeff() > 1e-10) return std::nullopt;
  const double least = std::numeric_limits<double>::epsilon() * l.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < size; ++i)
    if (l[i] < least && l[i] > -least) l[i] = 0;
  return l;
}

const CurveAnalysis::Rows& CurveAnalysis::rows_inside(int level, bool odd) const {
  if (!odd) return rows_at_anchor(CurveAnchor::inside, level);
  return odd_rows_.get(level, [&] {
    const std::int64_t at = 2 * (canonical_.size / 4) + 1;
    return from_canonical(one_step(level, at, rows_at_anchor(CurveAnchor::inside, level + 1)), at);
  });
}

const CurveAnalysis::Rows& CurveAnalysis::rows_near_end(int level, std::int64_t position, bool reversed) const {
  if (position < 0) position = 0;
  return end_rows_.get({level, position, reversed}, [&] { return found_rows_near_end(level, position, reversed); });
}

CurveAnalysis::Rows CurveAnalysis::found_rows_near_end(int level, std::int64_t position, bool reversed) const {
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
  return rows;
}

CurveAnalysis::Rows CurveAnalysis::on_canonical(const Rows& rows, const CurveOutline& curve, std::int64_t at) const {
  Rows result = rows;
  result.unknowns = unknowns_of(curve);
  result.position = result.first = result.second[0] = result.second[1] = Vector::Zero(curve.size * layout_.unknowns());
  for (size_t i = 0; i < rows.unknowns.size(); ++i) {
    const Eigen::Index row = Eigen::Index(i);
    if (rows.position[row] == 0 && rows.first[row] == 0 && rows.second[0][row] == 0 && rows.second[1][row] == 0)
      continue;
    const Index a = column(curve, rows.unknowns[i], at);
    result.position[a] = rows.position[i];
    result.first[a] = rows.first[i];
    for (int side : {0, 1}) result.second[side][a] = rows.second[side][Eigen::Index(i)];
  }
  return result;
}

CurveAnalysis::Rows CurveAnalysis::one_step(int level, std::int64_t at, const Rows& rows) const {
  const CurveOutline child = layout_.child(canonical_);
  return pulled_back(on_canonical(rows, child, 2 * at), canonical_matrix(level, false), unknowns_of(canonical_));
}

CurveAnalysis::Rows CurveAnalysis::from_canonical(const Rows& rows, std::int64_t at) const {
  Rows result = rows;
  result.unknowns.clear();
  std::vector<Index> kept;
  for (Index a = 0; a < Index(rows.unknowns.size()); ++a)
    if (rows.position[a] != 0 || rows.first[a] != 0 || rows.second[0][a] != 0 || rows.second[1][a] != 0) {
      kept.push_back(a);
      result.unknowns.push_back({rows.unknowns[a].position - at, rows.unknowns[a].component});
    }
  result.position = rows.position(kept);
  result.first = rows.first(kept);
  for (int side : {0, 1}) result.second[side] = rows.second[side](kept);
  return result;
}

}  // namespace sublimit

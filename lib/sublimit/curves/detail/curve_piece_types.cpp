// SPDX-License-Identifier: Apache-2.0
// What is made once for each type of piece: blocks, limits, polynomials where there are any, orders, powers.
#include "sublimit/curves/detail/curve_pieces.h"

namespace sublimit {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int grid = 64;             // dyadic places that tell a polynomial
constexpr int enough_levels = 1100;  // deeper than any double
constexpr int most_powers = 11;      // a double starts with fewer than 2^11 zeros

}  // namespace

/// The level from which on masks stay the same.
int CurvePieces::settled_level(int level) const {
  const auto S = [&](int k) { return Matrix(curve_matrix(scheme_, {outline(2 * pad_ + 1)}, k)); };
  Matrix now = S(level);
  for (int k = level; k < level + enough_levels; ++k) {
    Matrix next = S(k + 1);
    if (next.rows() != now.rows() || next.cols() != now.cols())
      throw AnalysisError(scheme_.name + ": the masks of levels " + std::to_string(k) + " and " +
                          std::to_string(k + 1) + " do not reach equally far");
    if ((next - now).cwiseAbs().maxCoeff() <= eps) return k;
    now.swap(next);
  }
  throw AnalysisError(scheme_.name + ": the masks do not settle");
}

void CurvePieces::make_blocks(int at) {
  const int level = types_[at].level;
  const CurveOutline curve = canonical(types_[at]), fine = layout_.child(curve);
  const Index piece = canonical_piece(types_[at]), unknowns = layout_.unknowns();
  [[maybe_unused]] const Index pieces = num_pieces(curve);
  for (int c : {0, 1}) {
    const int child = add(2 * types_[at].before + c, 2 * types_[at].after + 1 - c, level + 1);
    types_[at].child[c] = child;
  }
  Type& type = types_[at];
  const auto moments = [&](const CurveOutline& outline, Index j) {  // of 1, and of x in edges of the level
    const PieceWindow w = window(outline, j);
    Matrix m(w.size * unknowns, 2);
    for (Index i = 0; i < w.size * unknowns; ++i) {
      const bool point = i % unknowns == 0;
      const std::int64_t x = layout_.position(outline, w.first + i / unknowns) - 2 * std::int64_t{j};
      m.row(i) << (point ? 1.0 : 0.0), (point ? static_cast<double>(x) / 2 : 1.0);
    }
    return m;
  };
  const Matrix mine = moments(curve, piece);
  type.width = static_cast<Index>(mine.rows());
  type.constant = mine.col(0);
  type.linear = mine.col(1);
  type.slope = type.linear - type.linear[0] * type.constant;
  if (type.width > 1) type.slope /= Eigen::VectorXd(type.slope)[1];
  assert(num_pieces(fine) == 2 * pieces);
  const CurveMatrix<double> S = curve_matrix(scheme_, {curve}, level);
  const PieceWindow parent = window(curve, piece);
  for (int c : {0, 1}) {
    const PieceWindow child = window(fine, 2 * piece + c);
    Matrix& B = type.B[c];
    B.setZero(child.size * unknowns, type.width);
    for (Index i = 0; i < B.rows(); ++i)
      for (CurveMatrix<double>::InnerIterator it(S, child.first * unknowns + i); it; ++it) {
        const Index column = static_cast<Index>(it.col()) - parent.first * unknowns;
        if (column < 0 || column >= type.width)
          throw AnalysisError(scheme_.name + ": masks of level " + std::to_string(level) +
                              " look further than those of level 0, or an end's rule further than its points");
        B(i, column) = it.value();
      }
    // Masks are rounded, and their powers would not sum to one.
    const Matrix theirs = moments(fine, 2 * piece + c);
    type.exact_B[c] = B.cast<Real>();
    for (Index i = 0; i < B.rows(); ++i) {
      Index largest = 0;
      for (Index j = 0; j < type.width; ++j)
        if (type.constant[j] != 0 && std::abs(B(i, j)) > std::abs(B(i, largest))) largest = j;
      const Real missing = Real(theirs(i, 0)) - type.exact_B[c].row(i).dot(type.constant.cast<Real>().transpose());
      if (std::abs(missing) < 1e-14) type.exact_B[c](i, largest) += missing;
    }
    const Eigen::VectorXd wrong = 2 * (B * type.linear) - theirs.col(1) - c * theirs.col(0);
    if (wrong.cwiseAbs().maxCoeff() > 1e-12 * type.width) type.keeps_linear = false;
  }
}

/// Powers of a block that repeats have equal rows in the end: the limit.
void CurvePieces::make_limits(Type& type) const {
  const int self = find(type.before, type.after, type.level);
  for (int c : {0, 1}) {
    if (type.child[c] != self || type.level < settled_) continue;
    MatrixL power = type.exact_B[c];
    const auto spread = [&] {  // of the rows of points
      Real sum = 0;
      for (Index i = 0; i < type.width; ++i)
        sum = std::max(sum, (power.row(i) - Real(type.constant[i]) * power.row(0)).cwiseAbs().maxCoeff());
      return sum;
    };
    for (int m = 0; m < 16 && spread() > 0; ++m) {
      MatrixL square = power * power;
      if (!square.allFinite()) break;
      power.swap(square);
    }
    if (!power.allFinite() || spread() > Real(eps) / 16 + 64 * std::numeric_limits<Real>::epsilon())
      throw AnalysisError(scheme_.name + ": eigenvalue 1 of a local matrix is not simple and dominant");
    Index nearest = 0;  // a point that stays is its own limit, to the last bit
    for (Index i = 0; i < type.width; ++i)
      if (type.constant[i] != 0 && type.linear[i] == c) nearest = i;
    type.limit[c] = power.row(nearest) / power.row(nearest).dot(type.constant.cast<Real>().transpose());
  }
}

/// Limit position at a dyadic place.
CurvePieces::RowL CurvePieces::value(int at, Real s) const {
  const Type& type = types_[at];
  if (s == 0 && type.limit[0].size() > 0) return type.limit[0];
  if (s == 1 && type.limit[1].size() > 0) return type.limit[1];
  const int c = s >= Real(0.5) ? 1 : 0;
  return value(type.child[c], 2 * s - c) * type.exact_B[c];
}

void CurvePieces::find_polynomials(int at) {
  Type& type = types_[at];
  if (type.level < settled_) return;
  // Windows at ends are shorter, but their pieces no simpler.
  const int highest = layout_.radius() * layout_.unknowns() + 2;
  std::vector<RowL> values;
  for (int i = 0; i <= grid; ++i) values.push_back(value(at, Real(i) / grid));
  if (const std::optional<CurvePolynomial> whole = polynomial_through(values, highest)) {
    type.polynomials = {*whole};
    return;
  }
  const auto middle = values.begin() + grid / 2;
  const std::optional<CurvePolynomial> halves[] = {polynomial_through({values.begin(), middle + 1}, highest),
                                                   polynomial_through({middle, values.end()}, highest)};
  if (halves[0] && halves[1]) type.polynomials = {*halves[0], *halves[1]};
}

/// Derivatives that polynomials share at the start of a piece and between its halves.
void CurvePieces::find_orders(Type& type) const {
  if (type.polynomials.empty()) return;  // vertices have their own
  const auto ends = [](const CurvePolynomial& p, double y, Index width, double scale) {
    Matrix rows(3, width);
    p.evaluate(y, 2, width, rows.data());
    rows.row(1) *= scale;
    rows.row(2) *= scale * scale;
    return rows;
  };
  const auto shared = [](const Matrix& a, const Matrix& b) {
    for (int k : {1, 2})
      if ((a.row(k) - b.row(k)).cwiseAbs().maxCoeff() > 1e-9 * (1 + b.row(k).cwiseAbs().maxCoeff())) return k - 1;
    return 2;
  };
  const auto scale = [](const Type& t) { return static_cast<double>(t.polynomials.size()); };
  if (type.polynomials.size() == 2)
    type.middle_order =
        shared(ends(type.polynomials[0], 1, type.width, 2), ends(type.polynomials[1], 0, type.width, 2));
  if (canonical_piece(type) == 0) return;  // the start of a curve
  const CurveOutline curve = canonical(type);
  const Index piece = canonical_piece(type), unknowns = layout_.unknowns(), all = curve.size * unknowns;
  const int before = find(piece - 1, num_pieces(curve) - piece, type.level);
  CurvePieceRows last;
  rows(before, 1, 2, true, last);
  Matrix left = Matrix::Zero(3, last.width);
  std::copy_n(last.weights.data(), (last.exists + 1) * last.width, left.data());
  const auto on_curve = [&](const Matrix& rows, Index j) {
    Matrix result = Matrix::Zero(3, all);
    result.middleCols(window(curve, j).first * unknowns, rows.cols()) = rows;
    return result;
  };
  type.start_order = std::min(
      last.exists,
      shared(on_curve(left, piece - 1), on_curve(ends(type.polynomials.front(), 0, type.width, scale(type)), piece)));
}

/// Derivatives where block c repeats: at the start or the end of the piece.
CurveVertex CurvePieces::vertex(const Type& type, int c) const {
  return curve_vertex(scheme_, canonical(type), type.level, 2 * (std::int64_t{canonical_piece(type)} + c));
}

void CurvePieces::make_vertices(Type& type) const {
  const Index first = window(canonical(type), canonical_piece(type)).first * layout_.unknowns();
  for (int c : {0, 1}) {
    if (type.limit[c].size() == 0) continue;
    CurveVertex found = vertex(type, c);
    const bool is_end = far_ > 0 && (c == 0 ? type.before : type.after) == 0;
    if (is_end && found.order() == 2)  // else it is a Taylor polynomial, but no derivative around the end
      found.has_second[0] = vertex(types_[find(far_, far_, type.level)], 0).has_second[0];
    Vertex& stored = type.vertex[c];
    stored.exists = found.order();
    stored.rows.setZero(3, type.width);
    stored.rows.row(0) = type.limit[c].cast<double>();
    // What lies beyond the window is rounding.
    if (stored.exists >= 1) stored.rows.row(1) = found.first.segment(first, type.width);
    if (stored.exists >= 2) stored.rows.row(2) = found.second[0].segment(first, type.width);
  }
}

/// Powers of blocks that repeat; those of derivatives without the unknowns that follow from the others.
void CurvePieces::make_powers(Type& type) const {
  for (int c : {0, 1}) {
    if (type.limit[c].size() == 0) continue;
    const MatrixL& B = type.exact_B[c];
    std::array<MatrixL, 3> power{B, 2 * B, 4 * B};
    for (int k : {1, 2}) {
      const bool without_linear = k == 2 && type.keeps_linear && type.width > 1;
      const MatrixL rows = power[k];
      for (Index i = 0; i < type.width; ++i) {
        // Unknown i with what it brings of the first ones.
        Real zeroth = type.constant[i];
        if (without_linear) {
          power[k].row(i) -= Real(type.slope[i]) * rows.row(1);
          zeroth -= Real(type.slope[i]) * Real(type.constant[1]);
        }
        power[k].row(i) -= zeroth * rows.row(0);
      }
      const Index dropped = without_linear ? 2 : 1;
      power[k].topRows(dropped).setZero();
      power[k].leftCols(dropped).setZero();
    }
    for (int m = 0; m < most_powers; ++m) {
      type.powers[c].push_back({power[0].cast<double>(), power[1].cast<double>(), power[2].cast<double>()});
      for (MatrixL& one : power) one = (one * one).eval();
    }
  }
}

}  // namespace sublimit

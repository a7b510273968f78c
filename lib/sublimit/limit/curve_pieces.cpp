// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/curve_pieces.h"

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "sublimit/analysis/curve_limits.h"

namespace sublimit {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int grid = 64;           // dyadic places that tell a polynomial
constexpr int most_degree = 20;    // above, Bernstein coefficients would lose the digits that long double adds
constexpr int most_levels = 1100;  // deeper than any double
constexpr int most_powers = 11;    // a double starts with fewer than 2^11 zeros

/// Weights of the Bernstein polynomials of a degree, by their recurrence: sums of positive terms.
template <class Real>
void bernstein(int degree, Real y, Real* weights) {
  weights[0] = 1;
  for (int d = 1; d <= degree; ++d) {
    weights[d] = y * weights[d - 1];
    for (int i = d - 1; i > 0; --i) weights[i] = (1 - y) * weights[i] + y * weights[i - 1];
    weights[0] *= 1 - y;
  }
}

}  // namespace

CurvePieces::CurvePieces(const CurveScheme<double>& scheme, int level, const std::vector<CurveOutline>& curves)
    : scheme_(scheme), layout_(scheme) {
  // The first piece whose window lies inside, and one more, whose neighbour does too.
  far_ = std::max(0, (layout_.begin() + layout_.radius() - 1) / 2);
  if (far_ > 0) ++far_;
  pad_ = far_ + layout_.radius() + layout_.end_points() + 2;
  settled_ = settled_level(level);
  for (const CurveOutline& curve : curves) {
    const Index pieces = num_pieces(curve);
    if (curve.closed)
      add(far_, far_, level);
    else
      for (Index j = 0; j < pieces; ++j) {
        if (j > far_ && pieces - 1 - j > far_) j = pieces - 1 - far_;
        add(j, pieces - 1 - j, level);
      }
  }
  for (int at = 0; at < num_types(); ++at) make_blocks(at);  // and adds children
  // What a piece keeps, its halves must keep.
  for (bool changed = true; changed;) {
    changed = false;
    for (Type& type : types_)
      for (const int child : type.child)
        if (type.keeps_linear && !types_[child].keeps_linear) {
          type.keeps_linear = false;
          changed = true;
        }
  }
  for (Type& type : types_) make_limits(type);
  for (int at = 0; at < num_types(); ++at) find_polynomials(at);
  for (int at = 0; at < num_types(); ++at) find_orders(at);
  for (Type& type : types_) make_powers(type);
  first_types_.assign((far_ + 1) * (far_ + 1), -1);
  for (const auto& [key, at] : numbers_)
    if (key[2] == std::min(level, settled_)) first_types_[key[0] * (far_ + 1) + key[1]] = at;
}

Index CurvePieces::num_polynomial() const {
  return static_cast<Index>(
      std::count_if(types_.begin(), types_.end(), [](const Type& type) { return !type.polynomials.empty(); }));
}

int CurvePieces::find(Index before, Index after, int level) const {
  return numbers_.at({clipped(before), clipped(after), std::min(level, settled_)});
}

int CurvePieces::add(Index before, Index after, int level) {
  const std::array<Index, 3> key{clipped(before), clipped(after), std::min(level, settled_)};
  const auto [at, is_new] = numbers_.try_emplace(key, num_types());
  if (is_new) {
    Type& type = types_.emplace_back();
    type.before = key[0];
    type.after = key[1];
    type.level = key[2];
  }
  return at->second;
}

CurveOutline CurvePieces::outline(Index pieces) const {
  constexpr Index any = 64;  // lengths differ by whole legs
  const Index end = static_cast<Index>(layout_.end(layout_.control(any, false)) / 2);
  return layout_.control(any + pieces - end, false);
}

CurveOutline CurvePieces::canonical(const Type& type) const {
  return outline(canonical_piece(type) + 1 + (type.after < far_ ? type.after : pad_));
}

PieceWindow CurvePieces::window(const CurveOutline& curve, Index piece) const {
  // Basis functions are zero at both ends of their support, which reaches as far as the masks.
  const std::int64_t low = 2 * std::int64_t{piece} - layout_.radius() + 2,
                     high = 2 * std::int64_t{piece} + layout_.radius();
  if (curve.closed) return {static_cast<Index>((low - curve.first) / 2), layout_.radius()};
  // Rules for points beyond an end see its first points.
  const bool at_start = low < layout_.begin(), at_end = layout_.end(curve) - high < layout_.begin();
  const Index all = curve.size, least = std::min<Index>(all, layout_.end_points());
  Index first = at_start ? 0 : layout_.point(curve, low), last = at_end ? all - 1 : layout_.point(curve, high);
  if (at_start) last = std::max(last, least - 1);
  if (at_end) first = std::min(first, all - least);
  return {first, last - first + 1};
}

/// The level from which on masks stay the same.
int CurvePieces::settled_level(int level) const {
  const auto S = [&](int k) { return Matrix(curve_matrix(scheme_, {outline(2 * pad_ + 1)}, k)); };
  Matrix now = S(level);
  for (int k = level; k < level + most_levels; ++k) {
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
  const auto moments = [&](const CurveOutline& outline, Index j) {  // of 1, and of x in legs of the level
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

/// The polynomial through values at equal distances, if there is one.
std::optional<CurvePieces::Polynomial> CurvePieces::polynomial(const std::vector<RowL>& values) const {
  const int last = static_cast<int>(values.size()) - 1;
  const Index width = static_cast<Index>(values[0].size());
  MatrixL best;
  Real least = 16 * Real(eps);
  // Windows at ends are shorter, but their pieces no simpler.
  const int highest = std::min(layout_.radius() * layout_.unknowns() + 2, most_degree);
  // The leading terms of high degrees are small, so the first that fits need not be the one: it goes on as long as one
  // of the next two (polynomials may be odd) fits better by far.
  for (int degree = 0; degree <= highest && (best.rows() == 0 || degree <= best.rows() + 1); ++degree) {
    // Nodes near to Chebyshev's.
    std::vector<int> nodes;
    for (int i = 0; i <= degree; ++i) {
      const double share = degree == 0 ? 0 : (1 - std::cos(std::numbers::pi * i / degree)) / 2;
      nodes.push_back(static_cast<int>(std::lround(last * share)));
    }
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) break;
    MatrixL collocation(degree + 1, degree + 1), right(degree + 1, width);
    std::vector<Real> weights(degree + 1);
    const auto at = [&](int i) {
      bernstein(degree, Real(i) / last, weights.data());
      return Eigen::Map<const RowL>(weights.data(), degree + 1);
    };
    for (int i = 0; i <= degree; ++i) {
      collocation.row(i) = at(nodes[i]);
      right.row(i) = values[nodes[i]];
    }
    MatrixL C = collocation.partialPivLu().solve(right);
    C.row(0) = values.front();
    C.row(degree) = values.back();
    Real error = 0;
    for (int i = 0; i <= last && error <= least; ++i)
      error = std::max(error, (at(i) * C - values[i]).cwiseAbs().maxCoeff());
    if (error > least) continue;
    best = C.unaryExpr([](Real x) { return std::abs(x) < Real(eps) / 16 ? Real(0) : x; });
    least = error / 8;
  }
  if (best.rows() == 0) return std::nullopt;
  Polynomial p;
  p.degree = static_cast<int>(best.rows()) - 1;
  p.coefficients[0] = best.cast<double>();
  for (int k = 1; k <= 2; ++k) {
    if (p.degree < k) {
      p.coefficients[k] = Matrix::Zero(1, width);
      continue;
    }
    const Eigen::Index rows = best.rows() - 1;
    best = (Real(rows) * (best.bottomRows(rows) - best.topRows(rows))).eval();
    p.coefficients[k] = best.cast<double>();
  }
  return p;
}

void CurvePieces::find_polynomials(int at) {
  Type& type = types_[at];
  if (type.level < settled_) return;
  std::vector<RowL> values;
  for (int i = 0; i <= grid; ++i) values.push_back(value(at, Real(i) / grid));
  if (const std::optional<Polynomial> whole = polynomial(values)) {
    type.polynomials = {*whole};
    return;
  }
  const auto middle = values.begin() + grid / 2;
  const std::optional<Polynomial> halves[] = {polynomial({values.begin(), middle + 1}),
                                              polynomial({middle, values.end()})};
  if (halves[0] && halves[1]) type.polynomials = {*halves[0], *halves[1]};
}

/// Rows of a polynomial at y, with derivatives by y.
void CurvePieces::evaluate(const Polynomial& p, double y, int derivatives, Index width, double* weights) {
  double basis[most_degree + 1];
  for (int k = 0; k <= derivatives; ++k) {
    const int degree = std::max(0, p.degree - k);
    bernstein(degree, y, basis);
    double* row = weights + k * width;
    std::fill(row, row + width, 0.0);
    for (int i = 0; i <= degree; ++i) {
      const double* coefficients = p.coefficients[k].data() + i * width;
      for (Index j = 0; j < width; ++j) row[j] += basis[i] * coefficients[j];
    }
  }
}

/// What derivatives two polynomials share where they meet; where there are others, the analysis of vertices tells.
void CurvePieces::find_orders(int at) {
  Type& type = types_[at];
  if (type.level < settled_) return;
  if (type.polynomials.empty()) {
    make_vertices(at);
    return;
  }
  const auto ends = [](const Polynomial& p, double y, Index width, double scale) {
    Matrix rows(3, width);
    evaluate(p, y, 2, width, rows.data());
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
  const Type& left = types_[find(piece - 1, num_pieces(curve) - piece, type.level)];
  if (left.polynomials.empty()) {
    CurveAnalysis<double> analysis(scheme_);
    type.start_order = analysis.limits(curve, type.level, {2 * std::int64_t{piece}}).order[0];
    return;
  }
  const auto on_curve = [&](const Matrix& rows, Index j) {
    Matrix result = Matrix::Zero(3, all);
    result.middleCols(window(curve, j).first * unknowns, rows.cols()) = rows;
    return result;
  };
  type.start_order = shared(on_curve(ends(left.polynomials.back(), 1, left.width, scale(left)), piece - 1),
                            on_curve(ends(type.polynomials.front(), 0, type.width, scale(type)), piece));
}

void CurvePieces::make_vertices(int at) {
  Type& type = types_[at];
  const CurveOutline curve = canonical(type);
  const Index piece = canonical_piece(type), unknowns = layout_.unknowns();
  const Index first = window(curve, piece).first * unknowns;
  CurveAnalysis<double> analysis(scheme_);
  for (int c : {0, 1}) {
    if (type.limit[c].size() == 0) continue;
    const CurveLimits<double> limits = analysis.limits(curve, type.level, {2 * (std::int64_t{piece} + c)});
    Vertex& vertex = type.vertex[c];
    vertex.exists = limits.order[0];
    vertex.rows.setZero(3, type.width);
    vertex.rows.row(0) = type.limit[c].cast<double>();
    const CurveMatrix<double>* parts[] = {&limits.first, &limits.second};
    for (int k = 1; k <= vertex.exists; ++k)
      for (CurveMatrix<double>::InnerIterator it(*parts[k - 1], 0); it; ++it) {
        const Index column = static_cast<Index>(it.col()) - first;  // what lies beyond the window is rounding
        if (column >= 0 && column < type.width) vertex.rows(k, column) = std::ldexp(it.value(), -k * type.level);
      }
  }
}

/// Powers of blocks that repeat; those of derivatives without the unknowns that follow from the others.
void CurvePieces::make_powers(Type& type) const {
  if (!type.polynomials.empty()) return;
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

/// Weights of the first unknowns, from the others: rows of derivatives sum to zero, those of second ones see nothing
/// linear.
void CurvePieces::project(const Type& type, int derivatives, double* weights) const {
  for (int k = 1; k <= derivatives; ++k) {
    double* row = weights + k * type.width;
    if (k == 2 && type.keeps_linear && type.width > 1) {
      double sum = 0;
      for (Index j = 2; j < type.width; ++j) sum += row[j] * type.slope[j];
      row[1] = -sum;
    }
    double sum = 0;
    for (Index j = 1; j < type.width; ++j) sum += row[j] * type.constant[j];
    row[0] = -sum;
  }
}

void CurvePieces::rows(const CurveOutline& curve, Index piece, double s, int order, bool one_sided,
                       CurvePieceRows& result) const {
  int at = curve.closed ? first_types_.back()
                        : first_types_[clipped(piece) * (far_ + 1) + clipped(num_pieces(curve) - 1 - piece)];
  // Down, by the digits of s.
  result.path.clear();
  int end = -1;  // the vertex where the way ends
  for (;;) {
    const Type& type = types_[at];
    if (!type.polynomials.empty()) break;
    if (s == 0 || s == 1) {
      end = s == 0 ? 0 : 1;
      if (type.vertex[end].exists >= 0) break;
      end = -1;
    }
    const int c = s >= 0.5 ? 1 : 0;
    if (type.child[c] == at && type.limit[c].size() > 0) {  // the same digit so many times
      const double rest = c == 0 ? s : 1 - s;
      int exponent = 0;
      const double mantissa = std::frexp(rest, &exponent);
      const int times = c == 1 && mantissa == 0.5 ? 1 - exponent : -exponent;
      s = c == 0 ? std::ldexp(rest, times) : 1 - std::ldexp(rest, times);
      for (int m = 0; times >> m != 0; ++m)
        if ((times >> m & 1) != 0) result.path.push_back({at, c, m});
    } else {
      result.path.push_back({at, c, -1});
      s = 2 * s - c;
      at = type.child[c];
    }
  }
  const Type* type = &types_[at];
  // The rows there.
  result.kink = false;
  const auto room = [&](int rows, Index width, std::vector<double>& weights) {
    if (weights.size() < size_t(rows) * width) weights.resize(size_t(rows) * width);
  };
  int derivatives = 0;
  if (end >= 0) {
    const Vertex& vertex = type->vertex[end];
    result.exists = vertex.exists;
    derivatives = std::min(order, vertex.exists);
    room(derivatives + 1, type->width, result.weights);
    std::copy_n(vertex.rows.data(), (derivatives + 1) * type->width, result.weights.data());
  } else {
    const int parts = static_cast<int>(type->polynomials.size()), part = parts == 2 && s >= 0.5 ? 1 : 0;
    result.exists = s == 0 && !one_sided ? type->start_order : 2;
    if (parts == 2 && s == 0.5) {
      result.kink = type->middle_order == 0;
      result.exists = result.kink ? 2 : type->middle_order;
    }
    derivatives = std::min(order, result.exists);
    room(derivatives + 1, type->width, result.weights);
    evaluate(type->polynomials[part], parts * s - part, derivatives, type->width, result.weights.data());
    for (int k = 1; k <= derivatives && parts == 2; ++k)
      for (Index j = 0; j < type->width; ++j) result.weights[k * type->width + j] *= k == 1 ? 2 : 4;
  }
  project(*type, derivatives, result.weights.data());
  // And back up.
  for (size_t i = result.path.size(); i-- > 0;) {
    const CurvePieceRows::Step& step = result.path[i];
    const Index from = type->width;
    type = &types_[step.piece];
    const Index width = type->width;
    room(derivatives + 1, width, result.before);
    for (int k = 0; k <= derivatives; ++k) {
      const Matrix& T = step.power < 0 ? type->B[step.child] : type->powers[step.child][step.power][k];
      const double factor = step.power < 0 ? 1 << k : 1;
      double* row = result.before.data() + k * width;
      std::fill(row, row + width, 0.0);
      for (Index a = 0; a < from; ++a) {
        const double weight = factor * result.weights[k * from + a];
        if (weight == 0) continue;
        const double* block = T.data() + std::int64_t{a} * width;
        for (Index j = 0; j < width; ++j) row[j] += weight * block[j];
      }
    }
    result.before.swap(result.weights);
    project(*type, derivatives, result.weights.data());
  }
  result.width = type->width;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/regular_pieces.h"

#include <algorithm>
#include <set>

#include "sublimit/certificates/numbers/detail/exact_solve.h"

namespace sublimit {
namespace {

using Weights = std::map<LatticePoint, Algebraic>;

/// Weights of the points around a corner of cells in its limit.
std::optional<Weights> corner_weights(const RegularMask<Algebraic>& mask) {
  const LatticePoint low = mask.low(), high = mask.high();
  std::vector<LatticePoint> around;
  for (int x = -high.x2; x <= -low.x2; ++x)
    for (int y = -high.y2; y <= -low.y2; ++y)
      if (mask.has_point({x, y})) around.push_back({x, y});
  const auto n = static_cast<Eigen::Index>(around.size());
  const Weights step = mask.plane_weights();
  DenseMatrix<Algebraic> M(n, n);
  for (Eigen::Index q = 0; q < n; ++q) {
    for (Eigen::Index p = 0; p < n; ++p) {
      const auto a = step.find(around[static_cast<size_t>(p)] - 2 * around[static_cast<size_t>(q)]);
      if (a != step.end()) M(q, p) = a->second;
    }
    M(q, q) -= Algebraic(1);
  }
  const auto kernel = kernel_line(std::move(M));
  if (!kernel) return std::nullopt;
  const Algebraic sum = kernel->sum();
  if (sum.is_zero()) return std::nullopt;
  Weights weights;
  for (Eigen::Index p = 0; p < n; ++p)
    if (!(*kernel)(p, 0).is_zero()) weights[around[static_cast<size_t>(p)]] = (*kernel)(p, 0) / sum;
  return weights;
}

/// Limits at all places X/2^k by the points of the plane.
class DyadicLimits {
 public:
  DyadicLimits(const RegularMask<Algebraic>& mask, Weights corner)
      : step_(mask.plane_weights()), corner_(std::move(corner)) {
    powers_.push_back({{LatticePoint{}, Algebraic(1)}});  // level 0: the point itself, at offset 0
  }
  /// Weight of point Q in the limit at x = X/2^k; X in halves, even.
  Algebraic weight(LatticePoint X, int k, LatticePoint Q) {
    Algebraic sum;
    const Weights& power = this->power(k);
    for (const auto& [P, l] : corner_) {
      const auto a = power.find(X + P - (1 << k) * Q);
      if (a != power.end()) sum += l * a->second;
    }
    return sum;
  }

 private:
  /// Weights of one point in those of level k, by P - 2^k Q.
  const Weights& power(int k) {
    while (static_cast<int>(powers_.size()) <= k) {
      Weights next;
      for (const auto& [at, weight] : powers_.back())
        for (const auto& [offset, factor] : step_) next[offset + 2 * at] += factor * weight;
      powers_.push_back(std::move(next));
    }
    return powers_[static_cast<size_t>(k)];
  }

  Weights step_, corner_;
  std::vector<Weights> powers_;
};

std::vector<RegularPiece> quarter_squares() {
  std::vector<RegularPiece> pieces;
  const std::array<LatticePoint, 4> corners{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  for (size_t k = 0; k < 4; ++k)
    pieces.push_back({PieceShape::triangle, {{corners[k], corners[(k + 1) % 4], {1, 1}}}, {}, {}});
  return pieces;
}

/// u and v of a place of the plane in a piece that is `scale` times as large.
PiecePlace<Algebraic> place_in(const std::array<LatticePoint, 3>& corners, int scale, LatticePoint at) {
  const LatticePoint a = scale * (corners[1] - corners[0]), b = scale * (corners[2] - corners[0]),
                     d = at - scale * corners[0];
  const long det = a.x2 * b.y2 - a.y2 * b.x2;
  return {Algebraic::ratio(d.x2 * b.y2 - d.y2 * b.x2, det), Algebraic::ratio(a.x2 * d.y2 - a.y2 * d.x2, det)};
}

bool inside(PieceShape shape, const PiecePlace<Algebraic>& p) {
  const double u(p.u), v(p.v);  // multiples of a quarter: exact enough to compare
  const double slack = 1e-9;
  return u > -slack && v > -slack && (shape == PieceShape::square ? std::max(u, v) : u + v) < 1 + slack;
}

/// The Bernstein coefficients of polynomials from their values at places i/m, j/m.
std::optional<DenseMatrix<Algebraic>> interpolation(PieceShape shape, int degree, int m) {
  const int n = Bernstein<Algebraic>::count(shape, degree, degree);
  DenseMatrix<Algebraic> values(n, n);
  for (int c = 0; c < n; ++c) {
    Bernstein<Algebraic> unit(shape, degree, degree);
    unit.coefficients()[static_cast<size_t>(c)] = Algebraic(1);
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= unit.last(i); ++j)
        values(static_cast<Eigen::Index>(unit.index(i, j)), c) =
            unit.at({Algebraic::ratio(i, m), Algebraic::ratio(j, m)});
  }
  return exact_inverse(values);
}

/// Fills in controls and functions of a piece by interpolation.
bool interpolate(RegularPiece& piece, const RegularMask<Algebraic>& mask, DyadicLimits& limits, int degree) {
  int k = 0, m = 1;
  while (m < degree) m *= 2, ++k;
  // Corners of quarter squares lie at odd halves: one level more brings all places to corners of cells.
  const int level = k + 1;
  const auto inverse = interpolation(piece.shape, degree, m);
  if (!inverse) return false;
  const LatticePoint low = mask.low(), high = mask.high();
  for (int x = -high.x2; x <= 2 - low.x2; ++x)
    for (int y = -high.y2; y <= 2 - low.y2; ++y) {
      if (!mask.has_point({x, y})) continue;
      Bernstein<Algebraic> f(piece.shape, degree, degree);
      DenseMatrix<Algebraic> values(inverse->rows(), 1);
      bool is_zero = true;
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= f.last(i); ++j) {
          const LatticePoint X = 2 * m * piece.corners[0] + 2 * i * (piece.corners[1] - piece.corners[0]) +
                                 2 * j * (piece.corners[2] - piece.corners[0]);
          Algebraic& value = values(static_cast<Eigen::Index>(f.index(i, j)), 0);
          value = limits.weight(X, level, {x, y});
          is_zero &= value.is_zero();
        }
      if (is_zero) continue;
      for (Eigen::Index c = 0; c < inverse->rows(); ++c)
        for (Eigen::Index r = 0; r < inverse->cols(); ++r)
          if (!values(r, 0).is_zero()) f.coefficients()[static_cast<size_t>(c)] += (*inverse)(c, r) * values(r, 0);
      piece.controls.push_back({x, y});
      piece.functions.push_back(std::move(f));
    }
  return !piece.controls.empty();
}

bool sums_to_one(const RegularPiece& piece) {
  for (size_t c = 0; c < piece.functions.front().coefficients().size(); ++c) {
    Algebraic sum;
    for (const Bernstein<Algebraic>& f : piece.functions) sum += f.coefficients()[c];
    if (!sum.is_one()) return false;
  }
  return true;
}

/// M_child S = D M, for one child and all points.
bool refines(const std::vector<RegularPiece>& pieces, const RegularMask<Algebraic>& mask, const ChildPiece& child) {
  const RegularPiece& parent = pieces[child.parent];
  const RegularPiece& fine = pieces[child.piece];
  std::map<LatticePoint, std::vector<Algebraic>> residual;
  const size_t size = fine.functions.front().coefficients().size();
  for (size_t p = 0; p < fine.controls.size(); ++p) {
    const LatticePoint P = fine.controls[p] + child.cell;
    for (const auto& [key, weight] : mask.weights) {
      const auto parent_point = mask.parent(P, mask.doubled(key));
      if (!parent_point) continue;
      const LatticePoint Q = *parent_point;
      std::vector<Algebraic>& r = residual.try_emplace(Q, size).first->second;
      for (size_t c = 0; c < size; ++c) r[c] -= fine.functions[p].coefficients()[c] * weight;
    }
  }
  for (size_t q = 0; q < parent.controls.size(); ++q) {
    std::vector<Algebraic>& r = residual.try_emplace(parent.controls[q], size).first->second;
    const Bernstein<Algebraic> seen =
        parent.functions[q].restricted(child.corners[0], child.corners[1], child.corners[2]);
    for (size_t c = 0; c < size; ++c) r[c] += seen.coefficients()[c];
  }
  return std::all_of(residual.begin(), residual.end(), [](const auto& r) {
    return std::all_of(r.second.begin(), r.second.end(), [](const Algebraic& x) { return x.is_zero(); });
  });
}

/// Partial derivatives of one order in the plane, x^order first.
std::vector<Bernstein<Algebraic>> partials(const RegularPiece& piece, const Bernstein<Algebraic>& f, int order) {
  std::vector<Bernstein<Algebraic>> result{f};
  const LatticePoint a = piece.corners[1] - piece.corners[0], b = piece.corners[2] - piece.corners[0];
  const long det = a.x2 * b.y2 - a.y2 * b.x2;
  // The gradient of (u, v) in the plane; squares have du/dy = dv/dx = 0, so that degrees never mix.
  const auto along = [&](const Bernstein<Algebraic>& g, const Algebraic& u, const Algebraic& v) {
    if (u.is_zero() || v.is_zero()) {
      Bernstein<Algebraic> d = u.is_zero() ? g.dv() : g.du();
      for (Algebraic& c : d.coefficients()) c *= u.is_zero() ? v : u;
      return d;
    }
    Bernstein<Algebraic> d = g.du();
    const Bernstein<Algebraic> e = g.dv();
    for (size_t c = 0; c < d.coefficients().size(); ++c)
      d.coefficients()[c] = u * d.coefficients()[c] + v * e.coefficients()[c];
    return d;
  };
  for (int k = 0; k < order; ++k) {
    std::vector<Bernstein<Algebraic>> next;
    for (const Bernstein<Algebraic>& g : result)
      next.push_back(along(g, Algebraic::ratio(b.y2, det), Algebraic::ratio(-a.y2, det)));
    next.push_back(along(result.back(), Algebraic::ratio(-b.x2, det), Algebraic::ratio(a.x2, det)));
    result = std::move(next);
  }
  return result;
}

/// Two pieces that share the edge from `from` to `to`; the second one in cell `cell`.
struct Seam {
  size_t first, second;
  LatticePoint cell, from, to;
};

std::vector<Seam> seams(const std::vector<RegularPiece>& pieces) {
  const auto outline = [](const RegularPiece& p, LatticePoint cell) {
    std::vector<LatticePoint> corners{p.corners[0] + cell, p.corners[1] + cell, p.corners[2] + cell};
    if (p.shape == PieceShape::square) {
      corners[2] = p.corners[1] + p.corners[2] - p.corners[0] + cell;
      corners.push_back(p.corners[2] + cell);
    }
    return corners;
  };
  std::vector<Seam> found;
  for (size_t s = 0; s < pieces.size(); ++s)
    for (size_t t = 0; t < pieces.size(); ++t)
      for (int x = -2; x <= 2; x += 2)
        for (int y = -2; y <= 2; y += 2) {
          if (s == t && x == 0 && y == 0) continue;
          const auto a = outline(pieces[s], {}), b = outline(pieces[t], {x, y});
          for (size_t i = 0; i < a.size(); ++i)
            for (size_t j = 0; j < b.size(); ++j)
              if (a[i] == b[(j + 1) % b.size()] && a[(i + 1) % a.size()] == b[j])
                found.push_back({s, t, {x, y}, a[i], a[(i + 1) % a.size()]});
        }
  return found;
}

/// All partial derivatives of this order agree along the seam.
bool agree(const std::vector<RegularPiece>& pieces, const Seam& seam, int order, int degree) {
  std::map<LatticePoint, std::vector<Algebraic>> jump;
  const auto add = [&](const RegularPiece& piece, LatticePoint cell, const Algebraic& sign) {
    const PiecePlace<Algebraic> from = place_in(piece.corners, 1, seam.from - cell),
                                to = place_in(piece.corners, 1, seam.to - cell);
    for (size_t q = 0; q < piece.controls.size(); ++q) {
      std::vector<Algebraic>& j = jump[piece.controls[q] + cell];
      size_t at = 0;
      for (const Bernstein<Algebraic>& d : partials(piece, piece.functions[q], order))
        for (int i = 0; i <= degree; ++i, ++at) {
          if (j.size() <= at) j.resize(at + 1);
          const Algebraic t = Algebraic::ratio(i, std::max(degree, 1));
          j[at] += sign * d.at({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
        }
    }
  };
  add(pieces[seam.first], {}, Algebraic(1));
  add(pieces[seam.second], seam.cell, Algebraic(-1));
  return std::all_of(jump.begin(), jump.end(), [](const auto& j) {
    return std::all_of(j.second.begin(), j.second.end(), [](const Algebraic& x) { return x.is_zero(); });
  });
}

}  // namespace

std::vector<RegularPiece> squares() { return {{PieceShape::square, {{{0, 0}, {2, 0}, {0, 2}}}, {}, {}}}; }

std::vector<RegularPiece> triangles() {
  return {{PieceShape::triangle, {{{0, 0}, {2, 0}, {0, 2}}}, {}, {}},
          {PieceShape::triangle, {{{2, 2}, {0, 2}, {2, 0}}}, {}, {}}};
}

std::vector<ChildPiece> child_pieces(const std::vector<RegularPiece>& pieces, int dilation) {
  std::vector<ChildPiece> found;
  for (size_t s = 0; s < pieces.size(); ++s)
    for (size_t t = 0; t < pieces.size(); ++t)
      for (int x = 0; x < 2 * dilation; x += 2)
        for (int y = 0; y < 2 * dilation; y += 2) {
          ChildPiece child{s, t, {x, y}, {}};
          bool all = true;
          for (size_t k = 0; k < 3; ++k) {
            child.corners[k] = place_in(pieces[s].corners, dilation, pieces[t].corners[k] + child.cell);
            all &= inside(pieces[s].shape, child.corners[k]);
          }
          if (all) found.push_back(std::move(child));
        }
  return found;
}

std::optional<RegularPieces> regular_pieces(const RegularMask<Algebraic>& mask, int most) {
  if (mask.dilation != 2) return std::nullopt;  // pieces of sqrt(3) would have to be triangles of nine children
  auto corner = corner_weights(mask);
  if (!corner) return std::nullopt;
  DyadicLimits limits(mask, std::move(*corner));
  const auto try_pieces = [&](std::vector<RegularPiece> pieces, int degree) -> std::optional<RegularPieces> {
    for (RegularPiece& piece : pieces)
      if (!interpolate(piece, mask, limits, degree) || !sums_to_one(piece)) return std::nullopt;
    for (const ChildPiece& child : child_pieces(pieces))
      if (!refines(pieces, mask, child)) return std::nullopt;
    RegularPieces found{mask, degree, degree, std::move(pieces)};
    const std::vector<Seam> all = seams(found.pieces);
    for (int order = 0; order <= degree; ++order)
      if (!std::all_of(all.begin(), all.end(), [&](const Seam& s) { return agree(found.pieces, s, order, degree); })) {
        found.continuity = order - 1;
        break;
      }
    return found;
  };
  for (int degree = 1; degree <= most; ++degree) {
    if (auto found = try_pieces(mask.triangular ? triangles() : squares(), degree)) return found;
    if (!mask.triangular && degree <= 3)
      if (auto found = try_pieces(quarter_squares(), degree)) return found;
  }
  return std::nullopt;
}

}  // namespace sublimit

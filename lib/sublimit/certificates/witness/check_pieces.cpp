// SPDX-License-Identifier: Apache-2.0
// The exact half of the checker: pieces are what the mask refines to, and fit together.
#include <set>

#include "sublimit/certificates/witness/witness_parts.h"

namespace sublimit::witness {
namespace {

using PieceCoordinates = std::array<Exact, 2>;

/// All B_i of a degree at t.
std::vector<Exact> line(int degree, const Exact& t) {
  std::vector<Exact> b{Exact(1)};
  for (int d = 1; d <= degree; ++d) {  // B_i^d = (1 - t) B_i^(d-1) + t B_(i-1)^(d-1)
    b.push_back(Exact(0));
    for (size_t i = b.size(); i-- > 0;) b[i] = (Exact(1) - t) * b[i] + (i > 0 ? t * b[i - 1] : Exact(0));
  }
  return b;
}

Exact power(const Exact& x, int k) { return k == 0 ? Exact(1) : power(x, k - 1) * x; }
int choose(int n, int k) { return k == 0 ? 1 : choose(n - 1, k - 1) * n / k; }

bool inside(const Parts& w, const PieceCoordinates& p) {
  const double u(p[0]), v(p[1]), slack = 1e-9;  // quarters
  return u > -slack && v > -slack && (w.squares ? std::max(u, v) : u + v) < 1 + slack;
}

PieceCoordinates corner_of(Spot s, Spot cell) {
  return {Exact::ratio(s[0] + cell[0], 1), Exact::ratio(s[1] + cell[1], 1)};
}

/// Place of the plane at u and v of a piece.
PieceCoordinates in_plane(const Piece& p, Spot cell, const Exact& u, const Exact& v) {
  PieceCoordinates at;
  for (size_t k = 0; k < 2; ++k)
    at[k] = Exact(p.corners[0][k] + cell[k]) + u * Exact(p.corners[1][k] - p.corners[0][k]) +
            v * Exact(p.corners[2][k] - p.corners[0][k]);
  return at;
}

Exact value(const std::vector<Exact>& f, const std::vector<Exact>& b) {
  Exact sum;
  for (size_t c = 0; c < f.size(); ++c) sum += f[c] * b[c];
  return sum;
}

/// Derivative by u (v) of all functions of a piece at a place.
std::vector<Exact> derivatives(const Parts& w, const Piece& piece, const PieceCoordinates& at, bool by_u) {
  const int d = w.degree, du = w.squares && !by_u ? d : d - 1, dv = w.squares && by_u ? d : d - 1;
  const std::vector<Exact> b = basis(w.squares, du, dv, at[0], at[1]);
  std::vector<Exact> result(piece.controls.size());
  size_t c = 0;
  for (int k = 0; k <= du; ++k)
    for (int l = 0; l <= (w.squares ? dv : du - k); ++l, ++c) {
      const auto index = [&](int m, int o) {
        return static_cast<size_t>(w.squares ? m * (d + 1) + o : m * (d + 1) - m * (m - 1) / 2 + o);
      };
      for (size_t q = 0; q < result.size(); ++q)
        result[q] += Exact(d) *
                     (piece.functions[q][by_u ? index(k + 1, l) : index(k, l + 1)] - piece.functions[q][index(k, l)]) *
                     b[c];
    }
  return result;
}

/// Value, x derivative and y derivative of all functions at a place of the plane.
std::array<std::vector<Exact>, 3> jet(const Parts& w, const Piece& piece, const PieceCoordinates& at) {
  const PieceCoordinates p = place_in(piece.corners, 1, at), o = place_in(piece.corners, 1, {Exact(0), Exact(0)}),
                         x = place_in(piece.corners, 1, {Exact(1), Exact(0)}),
                         y = place_in(piece.corners, 1, {Exact(0), Exact(1)});
  const std::vector<Exact> b = basis(w.squares, w.degree, w.degree, p[0], p[1]), fu = derivatives(w, piece, p, true),
                           fv = derivatives(w, piece, p, false);
  std::array<std::vector<Exact>, 3> all;
  for (size_t q = 0; q < piece.controls.size(); ++q) {
    all[0].push_back(value(piece.functions[q], b));
    all[1].push_back((x[0] - o[0]) * fu[q] + (x[1] - o[1]) * fv[q]);
    all[2].push_back((y[0] - o[0]) * fu[q] + (y[1] - o[1]) * fv[q]);
  }
  return all;
}

}  // namespace

std::vector<Exact> basis(bool squares, int du, int dv, const Exact& u, const Exact& v) {
  std::vector<Exact> all;
  if (squares) {
    const std::vector<Exact> a = line(du, u), b = line(dv, v);
    for (const Exact& x : a)
      for (const Exact& y : b) all.push_back(x * y);
    return all;
  }
  const Exact rest = Exact(1) - u - v;
  for (int i = 0; i <= du; ++i)
    for (int j = 0; j <= du - i; ++j)
      all.push_back(Exact(choose(du, i) * choose(du - i, j)) * power(u, i) * power(v, j) * power(rest, du - i - j));
  return all;
}

std::array<Exact, 2> place_in(const std::array<Spot, 3>& c, int scale, const std::array<Exact, 2>& at) {
  const long ax = c[1][0] - c[0][0], ay = c[1][1] - c[0][1], bx = c[2][0] - c[0][0], by = c[2][1] - c[0][1];
  const Exact dx = at[0] / Exact(scale) - Exact(c[0][0]), dy = at[1] / Exact(scale) - Exact(c[0][1]);
  const Exact det(ax * by - ay * bx);
  return {(dx * Exact(by) - dy * Exact(bx)) / det, (Exact(ax) * dy - Exact(ay) * dx) / det};
}

void check_pieces(const Parts& w, std::vector<std::string>& problems) {
  const auto fail = [&](const std::string& what) { problems.push_back("pieces: " + what); };
  const int d = w.degree;
  for (const Piece& piece : w.pieces)
    for (size_t c = 0; c < piece.functions.front().size(); ++c) {
      Exact sum;
      for (const auto& f : piece.functions) sum += f[c];
      if (!sum.is_one()) return fail("coefficients of a piece do not sum to 1");
    }
  // Each child agrees with its parent at places enough for a polynomial.
  for (const Piece& parent : w.pieces)
    for (const Piece& fine : w.pieces)
      for (const Spot cell : {Spot{0, 0}, {2, 0}, {0, 2}, {2, 2}}) {
        bool all = true;
        for (const Spot& corner : fine.corners) all &= inside(w, place_in(parent.corners, 2, corner_of(corner, cell)));
        if (!all) continue;
        std::vector<std::map<Spot, Exact>> rows;
        for (const Spot& p : fine.controls) rows.push_back(mask_row(w, {p[0] + cell[0], p[1] + cell[1]}));
        for (int i = 0; i <= d; ++i)
          for (int j = 0; j <= (w.squares ? d : d - i); ++j) {
            const Exact u = Exact::ratio(i, d), v = Exact::ratio(j, d);
            const PieceCoordinates there = place_in(parent.corners, 2, in_plane(fine, cell, u, v));
            std::map<Spot, Exact> residual;
            const std::vector<Exact> b = basis(w.squares, d, d, u, v), B = basis(w.squares, d, d, there[0], there[1]);
            for (size_t q = 0; q < parent.controls.size(); ++q)
              residual[parent.controls[q]] += value(parent.functions[q], B);
            for (size_t p = 0; p < fine.controls.size(); ++p) {
              const Exact f = value(fine.functions[p], b);
              for (const auto& [Q, weight] : rows[p]) residual[Q] -= f * weight;
            }
            for (const auto& [Q, r] : residual)
              if (!r.is_zero()) return fail("a child is not what the mask makes of its parent");
          }
      }
  // And neighbours have equal values and derivatives along their seam.
  const auto outline = [&](const Piece& p, Spot cell) {
    std::vector<Spot> o;
    for (const Spot& c : p.corners) o.push_back({c[0] + cell[0], c[1] + cell[1]});
    if (w.squares) o.insert(o.begin() + 2, Spot{o[1][0] + o[2][0] - o[0][0], o[1][1] + o[2][1] - o[0][1]});
    return o;
  };
  for (const Piece& first : w.pieces)
    for (const Piece& second : w.pieces)
      for (int x = -2; x <= 2; x += 2)
        for (int y = -2; y <= 2; y += 2) {
          if (&first == &second && x == 0 && y == 0) continue;
          const std::vector<Spot> a = outline(first, {0, 0}), b = outline(second, {x, y});
          const std::set<Spot> theirs(b.begin(), b.end());
          for (size_t i = 0; i < a.size(); ++i) {
            const Spot from = a[i], to = a[(i + 1) % a.size()];
            if (!theirs.contains(from) || !theirs.contains(to)) continue;
            for (int k = 0; k <= d; ++k) {
              const Exact t = Exact::ratio(k, d);
              const PieceCoordinates at{Exact(from[0]) + t * Exact(to[0] - from[0]),
                                        Exact(from[1]) + t * Exact(to[1] - from[1])};
              const auto own = jet(w, first, at), other = jet(w, second, {at[0] - Exact(x), at[1] - Exact(y)});
              std::map<Spot, std::array<Exact, 3>> jump;
              for (size_t e = 0; e < 3; ++e) {
                for (size_t q = 0; q < own[e].size(); ++q) jump[first.controls[q]][e] += own[e][q];
                for (size_t q = 0; q < other[e].size(); ++q)
                  jump[{second.controls[q][0] + x, second.controls[q][1] + y}][e] -= other[e][q];
              }
              for (const auto& [Q, j] : jump)
                if (!j[0].is_zero() || !j[1].is_zero() || !j[2].is_zero()) return fail("neighbours are not C^1");
            }
          }
        }
}

}  // namespace sublimit::witness

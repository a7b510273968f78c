// SPDX-License-Identifier: Apache-2.0
// The geometric half of the checker: the pieces cover a sector of a ring, nothing folds, the boundary winds once.
#include <optional>
#include <set>

#include "sublimit/certificates/witness/witness_parts.h"

namespace sublimit::witness {
namespace {

using PieceCoordinates = std::array<Exact, 2>;

int ring_of(const Parts& w, Spot p) { return w.triangular ? p[0] + p[1] : std::max(p[0], p[1]); }

/// The net at any place of the plane around sector 0: further out by the mask.
class Net {
 public:
  explicit Net(const Parts& w) : w_(w), known_(w.net) {}
  std::optional<ComplexBall> operator()(Spot p) {
    Label label;
    if (!find_label(w_, p, label)) return std::nullopt;
    const Spot own{label[1], label[2]};
    if (own == Spot{0, 0}) return ComplexBall(0);
    if (!known_.contains(own)) {
      ComplexBall sum(0);
      for (const auto& [Q, weight] : mask_row(w_, own)) {
        Label from;
        if (!find_label(w_, Q, from) || ring_of(w_, {from[1], from[2]}) >= ring_of(w_, own)) return std::nullopt;
        const auto z = (*this)(Q);
        if (!z) return std::nullopt;
        sum += weight.enclosure() * *z;
      }
      known_[own] = sum / ComplexBall(w_.lambda);
    }
    return known_[own] * ComplexBall::root_of_unity(label[0], w_.n);
  }

 private:
  const Parts& w_;
  std::map<Spot, ComplexBall> known_;
};

/// The row of P, where there is one, is the mask's. Beyond the rows there is but the mask.
bool is_regular(const Parts& w, Spot P) {
  Label label;
  if (!find_label(w, P, label)) return false;
  const auto row = w.rows.find({label[1], label[2]});
  int last = 0;
  for (const Spot& l : w.labels) last = std::max(last, ring_of(w, l));
  if (row == w.rows.end()) return ring_of(w, {label[1], label[2]}) > last;
  std::map<Label, Exact> expected;
  for (const auto& [Q, weight] : mask_row(w, P)) {
    Label from;
    if (!find_label(w, Q, from)) return false;
    if (from[1] != 0 || from[2] != 0) from[0] = (from[0] - label[0] + w.n) % w.n;
    expected[from] += weight;
  }
  if (expected.size() != row->second.size()) return false;
  for (const auto& [from, weight] : row->second)
    if (!expected.contains(from) || !(expected[from] == weight)) return false;
  return true;
}

/// Corners u = v = 0, u = 1, v = 1 of a part of a piece.
std::array<PieceCoordinates, 3> part(bool squares, const std::string& path) {
  std::array<PieceCoordinates, 3> p{{{Exact(0), Exact(0)}, {Exact(1), Exact(0)}, {Exact(0), Exact(1)}}};
  const auto between = [](const PieceCoordinates& a, const PieceCoordinates& b) {
    return PieceCoordinates{(a[0] + b[0]) / Exact(2), (a[1] + b[1]) / Exact(2)};
  };
  for (const char q : path) {
    const PieceCoordinates ou = between(p[0], p[1]), ov = between(p[0], p[2]), uv = between(p[1], p[2]);
    const PieceCoordinates far_u{ou[0] + p[2][0] - p[0][0], ou[1] + p[2][1] - p[0][1]},
        far_v{ov[0] + p[1][0] - p[0][0], ov[1] + p[1][1] - p[0][1]};
    if (squares)
      p = q == '0'   ? std::array{p[0], ou, ov}
          : q == '1' ? std::array{ou, p[1], uv}
          : q == '2' ? std::array{ov, uv, p[2]}
                     : std::array{uv, far_v, far_u};
    else
      p = q == '0'   ? std::array{p[0], ou, ov}
          : q == '1' ? std::array{ou, p[1], uv}
          : q == '2' ? std::array{ov, uv, p[2]}
                     : std::array{uv, ov, ou};
  }
  return p;
}

/// From values at (i/m, j/m) to Bernstein coefficients, m the degree.
std::vector<std::vector<Ball>> interpolation(bool squares, int degree) {
  std::vector<std::vector<Exact>> V, right;
  const int m = std::max(degree, 1);
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= (squares ? degree : degree - i); ++j)
      V.push_back(basis(squares, degree, degree, Exact::ratio(i, m), Exact::ratio(j, m)));
  for (size_t i = 0; i < V.size(); ++i) {
    right.emplace_back(V.size());
    right.back()[i] = Exact(1);
  }
  solve(V, right);
  std::vector<std::vector<Ball>> inverse;
  for (const auto& row : right) {
    inverse.emplace_back();
    for (const Exact& e : row) inverse.back().push_back(e.real_enclosure());
  }
  return inverse;
}

/// Value and derivatives of all functions of a piece at a place, in balls.
struct Jets {
  std::vector<Ball> f, fu, fv;
};

Jets jets(const Parts& w, const Piece& piece, const PieceCoordinates& at) {
  const int d = w.degree;
  const auto b = basis(w.squares, d, d, at[0], at[1]),
             bu = basis(w.squares, d - 1, w.squares ? d : d - 1, at[0], at[1]),
             bv = basis(w.squares, w.squares ? d : d - 1, d - 1, at[0], at[1]);
  const auto index = [&](int i, int j) {
    return static_cast<size_t>(w.squares ? i * (d + 1) + j : i * (d + 1) - i * (i - 1) / 2 + j);
  };
  Jets r;
  for (const auto& g : piece.functions) {
    Exact f, fu, fv;
    for (size_t c = 0; c < b.size(); ++c) f += g[c] * b[c];
    size_t c = 0;
    for (int i = 0; i < d; ++i)
      for (int j = 0; j <= (w.squares ? d : d - 1 - i); ++j) fu += (g[index(i + 1, j)] - g[index(i, j)]) * bu[c++];
    c = 0;
    for (int i = 0; i <= (w.squares ? d : d - 1); ++i)
      for (int j = 0; j <= (w.squares ? d - 1 : d - 1 - i); ++j) fv += (g[index(i, j + 1)] - g[index(i, j)]) * bv[c++];
    r.f.push_back(f.real_enclosure());
    r.fu.push_back((Exact(d) * fu).real_enclosure());
    r.fv.push_back((Exact(d) * fv).real_enclosure());
  }
  return r;
}

Ball dot(const std::vector<Ball>& a, const std::vector<Ball>& b) {
  Ball sum(0);
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void check_map(const Parts& w, std::vector<std::string>& problems) {
  const auto fail = [&](const std::string& what) { problems.push_back("map: " + what); };
  const int r = w.ring, J_degree = w.squares ? 2 * w.degree - 1 : 2 * w.degree - 2;
  Net net(w);
  // Which pieces there must be, and that leaves cover each.
  std::map<std::pair<size_t, Spot>, double> covered;
  std::set<std::pair<std::pair<size_t, Spot>, std::string>> seen;
  for (const Leaf& leaf : w.leaves) {
    if (leaf.path.size() > 12 || leaf.path.find_first_not_of("0123") != std::string::npos)
      return fail("a path is none");
    for (size_t k = 0; k <= leaf.path.size(); ++k)
      if (seen.contains({{leaf.piece, leaf.cell}, leaf.path.substr(0, k)})) return fail("a part is there twice");
    // Paths are in order: those within this part come right after it.
    const auto within = seen.lower_bound({{leaf.piece, leaf.cell}, leaf.path});
    if (within != seen.end() && within->first == std::pair(leaf.piece, leaf.cell) &&
        within->second.compare(0, leaf.path.size(), leaf.path) == 0)
      return fail("a part is there twice");
    seen.insert({{leaf.piece, leaf.cell}, leaf.path});
    double size = 1;
    for (size_t k = 0; k < leaf.path.size(); ++k) size /= 4;
    covered[{leaf.piece, leaf.cell}] += size;
  }
  size_t count = 0;
  for (int x = 0; x < 4 * r; x += 2)
    for (int y = 0; y < 4 * r; y += 2)
      for (size_t k = 0; k < w.pieces.size(); ++k) {
        // Squares lie in rings as a whole; triangles by their middle.
        const int middle = w.triangular ? 3 * (x + y) + (k == 0 ? 4 : 8) : 3 * std::max(x, y) + 3;
        if (middle < 6 * r || middle > 12 * r) continue;
        ++count;
        const auto at = covered.find({k, Spot{x, y}});
        if (at == covered.end() || at->second != 1) return fail("a piece is not covered");
      }
  if (count != covered.size()) return fail("there are pieces outside the ring");
  const auto to_coefficients = interpolation(w.squares, J_degree);
  std::map<std::pair<size_t, std::string>, std::vector<Jets>> jets_of;
  const auto coordinates = [&](size_t k, Spot cell, std::vector<Ball>& X, std::vector<Ball>& Y) {
    for (const Spot& p : w.pieces[k].controls) {
      const auto z = net({p[0] + cell[0], p[1] + cell[1]});
      if (!z) return false;
      X.push_back(z->re());
      Y.push_back(z->im());
    }
    return true;
  };
  for (const Leaf& leaf : w.leaves) {
    const Piece& piece = w.pieces[leaf.piece];
    // Children of its control points are made by the mask: so the limit is the piece's polynomial.
    for (const Piece& child : w.pieces)
      for (const Spot cell : {Spot{0, 0}, {2, 0}, {0, 2}, {2, 2}}) {
        bool all = true;
        for (const Spot& c : child.corners) {
          const PieceCoordinates p = place_in(piece.corners, 2, {Exact(c[0] + cell[0]), Exact(c[1] + cell[1])});
          const double u(p[0]), v(p[1]), slack = 1e-9;
          all &= u > -slack && v > -slack && (w.squares ? std::max(u, v) : u + v) < 1 + slack;
        }
        if (!all) continue;
        for (const Spot& p : child.controls)
          if (!is_regular(w, {p[0] + cell[0] + 2 * leaf.cell[0], p[1] + cell[1] + 2 * leaf.cell[1]}))
            return fail("a piece is not in the regular part");
      }
    std::vector<Ball> X, Y;
    if (!coordinates(leaf.piece, leaf.cell, X, Y)) return fail("the net does not reach a piece");
    auto [nodes, is_new] = jets_of.try_emplace({leaf.piece, leaf.path});
    const std::array<PieceCoordinates, 3> corners = part(w.squares, leaf.path);
    if (is_new) {
      const int m = std::max(J_degree, 1);
      for (int i = 0; i <= J_degree; ++i)
        for (int j = 0; j <= (w.squares ? J_degree : J_degree - i); ++j) {
          const Exact s = Exact::ratio(i, m), t = Exact::ratio(j, m);
          PieceCoordinates at;
          for (size_t e = 0; e < 2; ++e)
            at[e] = corners[0][e] + s * (corners[1][e] - corners[0][e]) + t * (corners[2][e] - corners[0][e]);
          nodes->second.push_back(jets(w, piece, at));
        }
    }
    std::vector<Ball> J;
    for (const Jets& f : nodes->second) J.push_back(dot(f.fu, X) * dot(f.fv, Y) - dot(f.fv, X) * dot(f.fu, Y));
    double least = 1e300;
    for (const auto& row : to_coefficients) {
      const Ball c = dot(row, J);
      if (!certainly_positive(c)) return fail("the Jacobian may vanish");
      least = std::min(least, c.lower());
    }
    if (!(leaf.least > 0) || leaf.least > least * (1 + 1e-9) || leaf.least < least * (1 - 1e-6))
      return fail("a bound of the Jacobian is not what it is");
  }
  // The outer boundary of the sector, from (2 r, 0) on, stays on one side of a line through the centre.
  std::vector<std::vector<Exact>> V, right;
  for (int i = 0; i <= w.degree; ++i) {
    V.push_back(basis(true, w.degree, 0, Exact::ratio(i, w.degree), Exact(0)));
    right.emplace_back(static_cast<size_t>(w.degree) + 1);
    right.back()[static_cast<size_t>(i)] = Exact(1);
  }
  solve(V, right);
  std::optional<ComplexBall> start;
  std::vector<ComplexBall> boundary;
  for (const auto& [which, size] : covered) {
    const Piece& piece = w.pieces[which.first];
    std::vector<Spot> corners(piece.corners.begin(), piece.corners.end());
    if (w.squares) corners.insert(corners.begin() + 2, Spot{2, 2});
    std::vector<Ball> X, Y;
    coordinates(which.first, which.second, X, Y);
    for (size_t k = 0; k < corners.size(); ++k) {
      Spot a = corners[k], b = corners[(k + 1) % corners.size()];
      for (Spot* s : {&a, &b}) *s = {(*s)[0] + which.second[0], (*s)[1] + which.second[1]};
      const bool outer = w.triangular ? a[0] + a[1] == 4 * r && b[0] + b[1] == 4 * r
                                      : (a[0] == 4 * r && b[0] == 4 * r) || (a[1] == 4 * r && b[1] == 4 * r);
      if (!outer) continue;
      std::vector<ComplexBall> values;
      for (int i = 0; i <= w.degree; ++i) {
        const Exact t = Exact::ratio(i, w.degree);
        const PieceCoordinates in_plane{Exact(a[0] - which.second[0]) + t * Exact(b[0] - a[0]),
                                        Exact(a[1] - which.second[1]) + t * Exact(b[1] - a[1])};
        const Jets f = jets(w, piece, place_in(piece.corners, 1, in_plane));
        values.emplace_back(dot(f.f, X), dot(f.f, Y));
      }
      if (a == Spot{4 * r, 0}) start = values.front();
      if (b == Spot{4 * r, 0}) start = values.back();
      for (const auto& row : right) {
        ComplexBall c(0);
        for (size_t i = 0; i < values.size(); ++i) c += row[i].enclosure() * values[i];
        boundary.push_back(c);
      }
    }
  }
  if (!start) return fail("the boundary does not start on a spoke");
  const ComplexBall line = *start * ComplexBall::root_of_unity(1, 2L * w.n);
  for (const ComplexBall& c : boundary)
    if (!certainly_positive((c * conj(line)).re())) return fail("the boundary may turn back");
}

}  // namespace sublimit::witness

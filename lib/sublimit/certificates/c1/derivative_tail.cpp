// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/derivative_tail.h"

#include <algorithm>
#include <set>

namespace sublimit {
namespace {

using Weights = std::map<LatticePoint, Algebraic>;

/// b with a(z) = sum of b(z + i e), 0 <= i < D; nothing where a does not divide.
std::optional<Weights> divided(const Weights& a, LatticePoint e, int D) {
  Weights b;
  const auto at = [&](LatticePoint z) {
    const auto found = b.find(z);
    return found == b.end() ? Algebraic() : found->second;
  };
  // From the far end of each line along e; past its near end nothing may be left.
  std::set<LatticePoint> open;
  for (const auto& [z, weight] : a)
    for (int i = 0; i < 2 * D; ++i) open.insert(z - i * e);
  std::vector<LatticePoint> order(open.begin(), open.end());
  const auto along = [&](LatticePoint z) { return z.x2 * e.x2 + z.y2 * e.y2; };
  std::stable_sort(order.begin(), order.end(), [&](LatticePoint p, LatticePoint q) { return along(p) > along(q); });
  for (const LatticePoint z : order) {
    const auto found = a.find(z);
    Algebraic value = found == a.end() ? Algebraic() : found->second;
    for (int i = 1; i < D; ++i) value -= at(z + i * e);
    if (!value.is_zero()) b[z] = std::move(value);
  }
  // The identity itself, which also sees what was left over.
  Weights sum;
  for (const auto& [z, weight] : b)
    for (int i = 0; i < D; ++i) sum[z - i * e] += weight;
  for (const auto& [z, weight] : a) sum[z] -= weight;
  for (const auto& [z, rest] : sum)
    if (!rest.is_zero()) return std::nullopt;
  return b;
}

/// Norms of 1, 2 ... steps: the largest sum of moduli that makes one new point.
std::vector<Ball> norms(const Weights& b, int D, int most) {
  std::map<LatticePoint, Ball> power{{LatticePoint{}, Ball(1)}}, own;
  for (const auto& [z, weight] : b) own[z] = weight.real_enclosure();
  std::vector<Ball> result;
  int scale = 1;
  for (int step = 1; step <= most; ++step) {
    std::map<LatticePoint, Ball> next;  // b_L(z) = sum of b(z - D y) b_(L-1)(y)
    for (const auto& [y, p] : power)
      for (const auto& [z, w] : own) next[z + D * y] += w * p;
    power = std::move(next);
    scale *= D;
    std::map<LatticePoint, Ball> rows;
    for (const auto& [z, p] : power) {
      const auto residue = [&](int x) { return (x % (2 * scale) + 2 * scale) % (2 * scale); };
      rows[{residue(z.x2), residue(z.y2)}] += abs(p);
    }
    Ball greatest(0);
    for (const auto& [residue, sum] : rows)
      if (sum.upper() > greatest.upper()) greatest = sum;
    result.push_back(greatest);
  }
  return result;
}

/// From Q0 to Q0 + v in steps along g and h: where the steps are taken, and how many.
struct Path {
  std::vector<std::pair<int, LatticePoint>> steps;  ///< 0: along g, 1: along h; from there, or to there backwards
  int length = 0;
};

Path path(LatticePoint from, int alpha, LatticePoint g, int beta, LatticePoint h) {
  Path p;
  p.length = std::abs(alpha) + std::abs(beta);
  for (int k = std::min(alpha, 0); k < std::max(alpha, 0); ++k) p.steps.emplace_back(0, from + k * g);
  for (int k = std::min(beta, 0); k < std::max(beta, 0); ++k) p.steps.emplace_back(1, from + alpha * g + k * h);
  return p;
}

}  // namespace

std::optional<DerivativeTail> derivative_tail(const RegularMask<Algebraic>& mask, int most) {
  if (mask.dual) return std::nullopt;
  const int D = mask.dilation;
  const LatticePoint e1{2, 0}, e2{0, 2}, e3{-2, 2};
  DerivativeTail tail;
  const Weights weights = mask.plane_weights();
  const std::array<std::optional<Weights>, 2> first{divided(weights, e1, D), divided(weights, e2, D)};
  if (!first[0] || !first[1]) return std::nullopt;
  const std::vector<std::pair<LatticePoint, LatticePoint>> pairs =
      mask.triangular ? std::vector<std::pair<LatticePoint, LatticePoint>>{{e1, e2}, {e1, e3}, {e2, e3}}
                      : std::vector<std::pair<LatticePoint, LatticePoint>>{{e1, e1}, {e1, e2}, {e2, e2}};
  for (const auto& [e, f] : pairs) {
    auto once = divided(weights, e, D);
    auto twice = once ? divided(*once, f, D) : std::nullopt;
    if (!twice) return std::nullopt;
    tail.families.push_back({e, f, std::move(*twice)});
  }
  // Sum over all levels of D^k |second differences of level k| <= total * |those of level 0|.
  Ball total(0);
  std::vector<Ball> largest;  // D^i * norm of i steps
  for (const DerivativeTail::Family& family : tail.families) {
    const std::vector<Ball> of_family = norms(family.mask, D, most);
    Ball scale(1);
    for (size_t i = 0; i < of_family.size(); ++i) {
      scale *= Ball(D);
      const Ball m = scale * of_family[i];
      if (largest.size() <= i)
        largest.push_back(m);
      else if (m.upper() > largest[i].upper())
        largest[i] = m;
    }
  }
  Ball best;
  for (size_t L = 0; L < largest.size(); ++L) {
    if (!certainly_less(largest[L], Ball(1))) continue;
    Ball sum(1);
    for (size_t i = 0; i < L; ++i) sum += largest[i];
    sum /= Ball(1) - largest[L];
    if (tail.steps != 0 && sum.upper() >= best.upper()) continue;
    best = sum;
    tail.steps = static_cast<int>(L) + 1;
    tail.contraction = largest[L];
  }
  if (tail.steps == 0) return std::nullopt;
  tail.pieces = {.mask = mask, .degree = 0, .continuity = 0, .pieces = mask.triangular ? triangles() : squares()};
  std::vector<RegularPiece>& pieces = tail.pieces.pieces;
  tail.bases = {{LatticePoint{}, LatticePoint{}}};
  if (mask.triangular) tail.bases.push_back({LatticePoint{0, 2}, LatticePoint{2, 0}});
  // What a step changes in first differences, from one piece to its child.
  const std::vector<ChildPiece> children = child_pieces(pieces, D);
  std::vector<std::set<SecondDifference>> around(pieces.size());
  std::array<Ball, 2> change;
  for (const ChildPiece& child : children)
    for (size_t i = 0; i < 2; ++i) {
      const LatticePoint P = tail.bases[child.piece][i] + child.cell, Q0 = tail.bases[child.parent][i];
      Algebraic sum;
      Ball cost(0);
      for (const auto& [offset, weight] : *first[i]) {
        const auto Q = mask.parent(P, offset);
        if (!Q) continue;
        sum += Algebraic(D) * weight;
        const LatticePoint v = *Q - Q0;
        const int a = v.x2 / 2, b = v.y2 / 2;
        const Path p = !mask.triangular ? path(Q0, a, e1, b, e2)
                       : i == 0         ? path(Q0, a + b, e2, -a, e3)
                                        : path(Q0, a + b, e1, b, e3);
        // Families by what is stepped along: squares 11, 12 or 12, 22; triangles 12, 13 or 12, 23.
        for (const auto& [which, at] : p.steps) {
          const size_t family = mask.triangular ? (which == 0 ? 0 : i == 0 ? 1 : 2) : i + static_cast<size_t>(which);
          around[child.parent].insert({family, at});
        }
        cost += Ball(D) * abs(weight.real_enclosure()) * Ball(p.length);
      }
      if (!sum.is_one()) return std::nullopt;  // slopes of planes would change
      if (cost.upper() > change[i].upper()) change[i] = cost;
    }
  for (size_t i = 0; i < 2; ++i) tail.factor[i] = change[i] * best;
  // What the children's second differences come from, until nothing is added.
  for (bool grows = true; grows;) {
    grows = false;
    for (const ChildPiece& child : children)
      for (const SecondDifference& d : std::set<SecondDifference>(around[child.piece]))
        for (const auto& [offset, weight] : tail.families[d.family].mask)
          if (const auto Q = mask.parent(d.at + child.cell, offset))
            grows |= around[child.parent].insert({d.family, *Q}).second;
  }
  for (size_t k = 0; k < pieces.size(); ++k) {
    tail.around.emplace_back(around[k].begin(), around[k].end());
    std::set<LatticePoint> points{tail.bases[k][0], tail.bases[k][0] + e1, tail.bases[k][1], tail.bases[k][1] + e2};
    for (const SecondDifference& d : around[k]) {
      const DerivativeTail::Family& f = tail.families[d.family];
      for (const LatticePoint p : {d.at, d.at + f.e, d.at + f.f, d.at + f.e + f.f}) points.insert(p);
    }
    pieces[k].controls.assign(points.begin(), points.end());
  }
  return tail;
}

}  // namespace sublimit

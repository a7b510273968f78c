// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/turned_map.h"

#include <algorithm>

namespace sublimit {
namespace {

/// How often a piece is quartered: intervals of h are halved before that helps much.
constexpr int deepest_turn = 2;

/// Any valence that keeps the neighbouring sectors apart.
constexpr int many = 1000;

std::optional<Ball> positive_bound(const Bernstein<Ball>& f, int depth) {
  Ball least = f.coefficients().front();
  for (const Ball& c : f.coefficients())
    if (c.lower() < least.lower()) least = c;
  if (certainly_positive(least)) return Ball(least.lower());
  if (depth == deepest_turn) return std::nullopt;
  std::optional<Ball> all;
  for (const Bernstein<Ball>& quarter : f.quarters()) {
    const auto own = positive_bound(quarter, depth + 1);
    if (!own) return std::nullopt;
    if (!all || own->lower() < all->lower()) all = own;
  }
  return all;
}

}  // namespace

TurnedPoint TurnedMap::product(const TurnedPoint& x, const TurnedPoint& y) const {
  return {x.a * y.a - square_ * x.b * y.b, x.a * y.b + x.b * y.a};
}

TurnedMap::TurnedMap(Ball h, Ball lambda, const RegularMask<Algebraic>& mask, const std::vector<SectorLabel>& labels,
                     const std::vector<Ball>& net)
    : h_(std::move(h)), lambda_(std::move(lambda)), mask_(mask) {
  square_ = Ball(1) - h_ * h_;
  turn_ = {Ball(2) * h_ * h_ - Ball(1), Ball(2) * h_};
  back_ = {turn_.a, -turn_.b};
  for (size_t i = 0; i < labels.size(); ++i) {
    const LatticePoint p{labels[i].x2, labels[i].y2};
    if (p.y2 == 0) {
      net_[p] = {net[i], Ball(0)};
    } else if (p.x2 == p.y2) {
      net_[p] = {h_ * net[i], net[i]};
    } else if (p.x2 > p.y2) {
      const auto mirror = std::find(labels.begin(), labels.end(), SectorLabel{0, p.y2, p.x2});
      const Ball& b = net[static_cast<size_t>(mirror - labels.begin())];
      net_[p] = {net[i], b};
      net_[{p.y2, p.x2}] = product(turn_, {net[i], -b});
    }
  }
}

std::optional<TurnedPoint> TurnedMap::at(LatticePoint p) {
  const auto label = label_at(p, mask_.triangular, many);
  if (!label) return std::nullopt;
  const LatticePoint own{label->x2, label->y2};
  if (own == LatticePoint{}) return TurnedPoint{Ball(0), Ball(0)};
  auto known = net_.find(own);
  if (known == net_.end()) {
    TurnedPoint sum{Ball(0), Ball(0)};
    for (const auto& [key, weight] : mask_.weights) {
      const auto Q = mask_.parent(own, mask_.doubled(key));
      if (!Q) continue;
      const auto from = label_at(*Q, mask_.triangular, many);
      // Only what lies further in is known without going round in circles.
      if (!from || ring2({from->x2, from->y2}, mask_.triangular) >= ring2(own, mask_.triangular)) return std::nullopt;
      const auto value = at(*Q);
      if (!value) return std::nullopt;
      const Ball w = weight.real_enclosure();
      sum.a += w * value->a;
      sum.b += w * value->b;
    }
    known = net_.emplace(own, TurnedPoint{sum.a / lambda_, sum.b / lambda_}).first;
  }
  TurnedPoint z = known->second;
  const int sector = label->sector > many / 2 ? label->sector - many : label->sector;
  for (int s = 0; s < sector; ++s) z = product(turn_, z);
  for (int s = 0; s > sector; --s) z = product(back_, z);
  return z;
}

std::optional<MapPiece> TurnedMap::piece(const RegularPieces& pieces, const BallFunctions& functions,
                                         const PlacedPiece& placed) {
  const RegularPiece& kind = pieces.pieces[placed.piece];
  MapPiece result{Bernstein<Ball>(kind.shape, pieces.degree, pieces.degree),
                  Bernstein<Ball>(kind.shape, pieces.degree, pieces.degree)};
  for (size_t q = 0; q < kind.controls.size(); ++q) {
    const auto z = at(kind.controls[q] + placed.cell);
    if (!z) return std::nullopt;
    const auto& weights = functions[placed.piece][q].coefficients();
    for (size_t c = 0; c < weights.size(); ++c) {
      result.x.coefficients()[c] += weights[c] * z->a;
      result.y.coefficients()[c] += weights[c] * z->b;
    }
  }
  return result;
}

std::optional<Ball> TurnedMap::least_jacobian(const RegularPieces& pieces, const BallFunctions& functions, int ring) {
  std::optional<Ball> least;
  for (const PlacedPiece& placed : sector_pieces(pieces, ring)) {
    const auto of = piece(pieces, functions, placed);
    if (!of) return std::nullopt;
    const auto own = positive_bound(jacobian(*of), 0);
    if (!own) return std::nullopt;
    if (!least || own->lower() < least->lower()) least = own;
  }
  return least;
}

bool TurnedMap::winds_once(const RegularPieces& pieces, const BallFunctions& functions, int ring) {
  std::vector<TurnedPoint> curve;  // Bernstein coefficients along the outer edges
  std::optional<TurnedPoint> start;
  for (const PlacedPiece& placed : sector_pieces(pieces, ring)) {
    const RegularPiece& kind = pieces.pieces[placed.piece];
    const auto edges = outer_edges(kind, placed.cell, ring, pieces.mask.triangular);
    if (edges.empty()) continue;
    const auto of = piece(pieces, functions, placed);
    if (!of) return false;
    for (const auto& edge : edges) {
      const Bernstein<Ball> x = along(of->x, edge), y = along(of->y, edge);
      for (size_t c = 0; c < x.coefficients().size(); ++c) curve.push_back({x.coefficients()[c], y.coefficients()[c]});
    }
    const std::array<PiecePlace<Ball>, 3> at{{{Ball(0), Ball(0)}, {Ball(1), Ball(0)}, {Ball(0), Ball(1)}}};
    for (size_t i = 0; i < 3; ++i)
      if (kind.corners[i] + placed.cell == LatticePoint{4 * ring, 0})
        start = TurnedPoint{of->x.at(at[i]), of->y.at(at[i])};
  }
  if (!start || curve.empty()) return false;
  const TurnedPoint against = product({start->a, -start->b}, {h_, Ball(-1)});
  return std::all_of(curve.begin(), curve.end(),
                     [&](const TurnedPoint& z) { return certainly_positive(product(z, against).a); });
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
// The characteristic map of a scheme without polynomials, by its refined nets.
#include <algorithm>
#include <cmath>

#include "sublimit/certificates/c1/map_proof.h"

namespace sublimit {
namespace {

/// x +- error.
Ball around(const Ball& x, const Ball& error) {
  Ball r = x;
  arb_add_error(r.get(), error.get());
  return r;
}

/// Everything between 0 and x.
Ball part_of(const Ball& x) { return Ball::hull(Ball(0), Ball(1)) * x; }

bool interpolates(const RegularMask<Algebraic>& mask) {
  for (const auto& [key, weight] : mask.weights)  // of a mask that is not dual
    if (key[0] % mask.dilation == 0 && key[1] % mask.dilation == 0 && !(key == Offset{} && weight.is_one()))
      return false;
  return true;
}

class NetSearch {
 public:
  NetSearch(CharacteristicMap& map, const DerivativeTail& tail, MapProof& proof, int levels)
      : map_(map),
        tail_(tail),
        proof_(proof),
        levels_(levels),
        D_(tail.pieces.mask.dilation),
        children_(child_pieces(tail.pieces.pieces, D_)) {}

  bool positive = false, negative = false, failed = false;

  /// @param first  outer ring of the level-0 pieces, in halves, times D^level
  void look(size_t piece, LatticePoint cell, int level, int outer) {
    const auto& bases = tail_.bases[piece];
    std::array<ComplexBall, 2> difference;
    std::optional<ComplexBall> points[4] = {map_.at(bases[0] + cell), map_.at(bases[0] + cell + LatticePoint{2, 0}),
                                            map_.at(bases[1] + cell), map_.at(bases[1] + cell + LatticePoint{0, 2})};
    Ball x(0), y(0);  // the largest second differences
    for (const SecondDifference& d : tail_.around[piece]) {
      const DerivativeTail::Family& f = tail_.families[d.family];
      const LatticePoint at = d.at + cell;
      const auto a = map_.at(at), b = map_.at(at + f.e), c = map_.at(at + f.f), e = map_.at(at + f.e + f.f);
      if (!a || !b || !c || !e) {
        failed = true;
        return;
      }
      const ComplexBall z = *a + *e - *b - *c;
      arb_max(x.get(), x.get(), abs(z.re()).get(), PrecisionScope::bits());
      arb_max(y.get(), y.get(), abs(z.im()).get(), PrecisionScope::bits());
    }
    for (const auto& p : points)
      if (!p) {
        failed = true;
        return;
      }
    difference = {*points[1] - *points[0], *points[3] - *points[2]};
    std::array<ComplexBall, 2> derivative;
    for (size_t i = 0; i < 2; ++i)
      derivative[i] =
          ComplexBall(around(difference[i].re(), tail_.factor[i] * x), around(difference[i].im(), tail_.factor[i] * y));
    Ball J = derivative[0].re() * derivative[1].im() - derivative[0].im() * derivative[1].re();
    if (certainly_positive(J)) {
      positive = true;
      ++proof_.parts;
      proof_.level = std::max(proof_.level, level);
      // Relative to pieces of level 0: differences of level k are D^k times as large.
      const Ball scale = scale_at(level);
      J *= scale;
      if (proof_.parts == 1 || J.lower() < proof_.least.lower()) proof_.least = J;
      if (proof_.parts == 1 || J.upper() > proof_.greatest.upper()) proof_.greatest = J;
      add_boundary(piece, cell, outer, derivative);
      return;
    }
    if (certainly_negative(J)) {
      negative = true;
      proof_.fold = "level " + std::to_string(level) + ", cell (" + std::to_string(cell.x2 / 2) + ", " +
                    std::to_string(cell.y2 / 2) + ") of a sector, where it is " + J.text(6);
      return;
    }
    if (level == levels_) {
      failed = true;
      return;
    }
    for (const ChildPiece& child : children_)
      if (child.parent == piece && !failed) look(child.piece, D_ * cell + child.cell, level + 1, D_ * outer);
  }

  /// All boundary pieces keep to one side, seen from the centre.
  bool keeps_to(const ComplexBall& direction) const {
    return !boundary_.empty() && std::all_of(boundary_.begin(), boundary_.end(), [&](const ComplexBall& z) {
      return certainly_positive((z * conj(direction)).re());
    });
  }

 private:
  /// (D lambda)^(2 level): what makes determinants of level k those by the places of level 0.
  Ball scale_at(int level) const {
    Ball s(1);
    for (int k = 0; k < level; ++k) s *= Ball(D_) * map_.lambda.re() * Ball(D_) * map_.lambda.re();
    return s;
  }

  /// Where the limit along outer edges is: from an end, which it interpolates, at most along the derivative.
  void add_boundary(size_t piece, LatticePoint cell, int outer, const std::array<ComplexBall, 2>& derivative) {
    const RegularPiece& p = tail_.pieces.pieces[piece];
    const bool triangular = tail_.pieces.mask.triangular;
    std::vector<LatticePoint> corners(p.corners.begin(), p.corners.end());
    if (!triangular) corners.insert(corners.begin() + 2, p.corners[1] + p.corners[2] - p.corners[0]);
    for (size_t k = 0; k < corners.size(); ++k) {
      const LatticePoint a = corners[k] + cell, b = corners[(k + 1) % corners.size()] + cell;
      const bool on = triangular ? ring2(a, true) == outer && ring2(b, true) == outer
                                 : (a.x2 == outer && b.x2 == outer) || (a.y2 == outer && b.y2 == outer);
      if (!on) continue;
      const LatticePoint v = b - a;
      const ComplexBall along = derivative[0] * ComplexBall(v.x2 / 2) + derivative[1] * ComplexBall(v.y2 / 2);
      const ComplexBall from = *map_.at(a);
      boundary_.emplace_back(from.re() + part_of(along.re()), from.im() + part_of(along.im()));
    }
  }

  CharacteristicMap& map_;
  const DerivativeTail& tail_;
  MapProof& proof_;
  int levels_, D_;
  std::vector<ChildPiece> children_;
  std::vector<ComplexBall> boundary_;
};

}  // namespace

MapProof prove_map(CharacteristicMap& map, const DerivativeTail& tail, int ring, int levels) {
  MapProof proof;
  proof.ring = ring;
  proof.placed = sector_pieces(tail.pieces, ring);
  const int outer = 2 * tail.pieces.mask.dilation * ring;
  NetSearch search(map, tail, proof, levels);
  for (const PlacedPiece& p : proof.placed)
    if (!search.failed) search.look(p.piece, p.cell, 0, outer);
  if (search.negative && search.positive) proof.regular = MapProof::Regular::folds;
  if (search.failed || search.negative || proof.parts == 0) return proof;
  proof.regular = MapProof::Regular::yes;
  const auto start = map.at({outer, 0});
  // Nets of all levels have the limit's directions: they differ by lambda^k.
  proof.winds_once =
      interpolates(tail.pieces.mask) && start && search.keeps_to(*start * ComplexBall::root_of_unity(1, 2L * map.n));
  return proof;
}

std::optional<NetSigns> net_signs(CharacteristicMap& map, int ring, int level) {
  NetSigns signs{.level = level};
  int inner = 2 * ring;
  for (int k = 0; k < level; ++k) inner *= map.mask.dilation;
  const int outer = inner * map.mask.dilation;
  const bool triangular = map.mask.triangular;
  const int odd = map.mask.dual ? 1 : 0;
  double sum = 0;
  std::vector<double> all;
  for (int x = odd; x <= outer; x += 2)
    for (int y = odd; y <= outer; y += 2) {
      const LatticePoint p{x, y};
      if (ring2(p, triangular) < inner || ring2(p, triangular) + (triangular ? 2 : 0) > outer) continue;
      const auto a = map.at(p), b = map.at(p + LatticePoint{2, 0}), c = map.at(p + LatticePoint{0, 2}),
                 d = map.at(p + LatticePoint{2, 2});
      if (!a || !b || !c || !d) return std::nullopt;
      // All triangles of three of the corners: a quadrilateral is strictly convex where all four are positive.
      const auto det = [&](const ComplexBall& o, const ComplexBall& s, const ComplexBall& t) {
        const ComplexBall z = conj(s - o) * (t - o);
        all.push_back(z.im().mid());
      };
      det(*a, *b, *c);
      if (!triangular) {
        det(*b, *d, *a);
        det(*c, *a, *d);
      }
      det(*d, *c, *b);
    }
  for (const double v : all) sum += std::abs(v);
  if (all.empty() || sum == 0) return std::nullopt;
  signs.positive = std::count_if(all.begin(), all.end(), [](double v) { return v > 0; });
  signs.negative = static_cast<long>(all.size()) - signs.positive;
  signs.least = *std::min_element(all.begin(), all.end()) * static_cast<double>(all.size()) / sum;
  return signs;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/c1_certificate.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "sublimit/base/error.h"
#include "sublimit/certificates/spectra/for_all.h"
#include "sublimit/certificates/spectra/mirror.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;

/// All eigenvalues but 1 (block 0) and the leading pair of blocks 1 and n - 1 are smaller than lambda.
struct Dominance {
  std::optional<int> open;  ///< the block where that was not shown
  long power = 0;           ///< the largest m with ||B^m|| < lambda^m that was needed
};

Dominance dominance(const LocalPatch<Algebraic>& patch, const LeadingPair& pair, const DenseMatrix<ComplexBall>& B1) {
  Dominance result;
  const Ball lambda = pair.value.re();
  for (int k = 0; 2 * k <= patch.type.faces; ++k) {
    DenseMatrix<ComplexBall> B = k == 1 ? deflated(B1, pair.vector, pair.unit) : fourier_block(patch, k);
    if (k == 0) B = deflated(B, std::vector<ComplexBall>(static_cast<size_t>(B.rows()), ComplexBall(1)), 0);
    const auto power = power_below(std::move(B), lambda);
    if (!power) {
      result.open = k;
      return result;
    }
    result.power = std::max(result.power, *power);
  }
  return result;
}

/// How often nets are refined before a proof gives up, and for evidence.
constexpr int net_levels = 7, evidence_level = 3;

/// Control points of every piece come together: weights are not negative, and after some steps all points of a
/// descendant see one point of the piece in common, so that the diameter shrinks by a factor (Micchelli, Prautzsch
/// 1989, "Uniform refinement of curves").
bool contracts(const RegularPieces& pieces) {
  const auto is_positive = [](const auto& weight) { return certainly_positive(weight.second.real_enclosure()); };
  if (holds_for_all(pieces.mask.weights, is_positive) != true) return false;
  const std::vector<ChildPiece> children = child_pieces(pieces.pieces, pieces.mask.dilation);
  using Points = std::set<LatticePoint>;
  // By piece, of all descendants of one level: which points of the piece each of their points sees.
  std::vector<std::vector<std::pair<size_t, std::map<LatticePoint, Points>>>> seen(pieces.pieces.size());
  for (size_t k = 0; k < seen.size(); ++k) {
    std::map<LatticePoint, Points> own;
    for (const LatticePoint p : pieces.pieces[k].controls) own[p] = {p};
    seen[k].emplace_back(k, std::move(own));
  }
  for (int step = 0; step < 3; ++step) {
    ForAll all;
    for (auto& of_piece : seen) {
      std::vector<std::pair<size_t, std::map<LatticePoint, Points>>> next;
      for (const auto& [piece, points] : of_piece)
        for (const ChildPiece& child : children) {
          if (child.parent != piece) continue;
          std::map<LatticePoint, Points> finer;
          for (const LatticePoint p : pieces.pieces[child.piece].controls)
            for (const auto& [key, weight] : pieces.mask.weights) {
              const auto Q = pieces.mask.parent(p + child.cell, pieces.mask.doubled(key));
              if (!Q) continue;
              const auto from = points.find(*Q);
              if (from == points.end()) return false;
              finer[p].insert(from->second.begin(), from->second.end());
            }
          Points common = finer.begin()->second;
          for (const auto& of_point : finer)
            std::erase_if(common, [&](LatticePoint q) { return !of_point.second.contains(q); });
          all.look(!common.empty());
          next.emplace_back(child.piece, std::move(finer));
        }
      of_piece = std::move(next);
    }
    if (all.holds() == true) return true;
  }
  return false;
}

/// Some digits that a ball is certainly above.
std::string rounded_down(const Ball& x) {
  std::ostringstream text;
  text << std::setprecision(5) << x.lower() - 1e-4 * std::abs(x.lower());
  return text.str();
}

/// Signs of refined nets instead of a proof, where the spectrum is as it should be.
void add_evidence(C1Certificate& c, bool leads) {
  Verdict& v = c.verdict;
  const auto signs = net_signs(*c.map, 2, evidence_level);
  if (!signs) return;
  v.hypotheses.push_back({"quadrilaterals or triangles of the refined characteristic net are positive",
                          signs->negative == 0, By::floating,
                          std::to_string(signs->positive) + " of " + std::to_string(signs->positive + signs->negative) +
                              " after " + std::to_string(signs->level) + " steps"});
  if (!leads) return;
  v.answer = signs->negative == 0 ? Verdict::Answer::evidence_for : Verdict::Answer::evidence_against;
}

LocalPatch<Algebraic> patch_of(const Scheme<Algebraic>& scheme, const RegularMask<Algebraic>& mask, int n) {
  // Rings enough for the mask to go on outwards by itself.
  const int reach = (mask.reach2() + 1) / 2, rings = mask.dual ? reach - 1 : reach;
  auto patch = local_patch(scheme, {.kind = mask.dual ? Centre::Kind::face : Centre::Kind::vertex, .faces = n},
                           std::max(rings, 1));
  if (!patch) throw AnalysisError(scheme.name + ": no stationary neighbourhood of valence " + std::to_string(n));
  return std::move(*patch);
}

}  // namespace

C1Prover::C1Prover(Scheme<Algebraic> scheme) : scheme_(std::move(scheme)), mask_(regular_mask(scheme_)) {
  pieces_ = regular_pieces(mask_);
  if (pieces_) {
    functions_ = in_balls(*pieces_);
    converges_ = contracts(*pieces_);
  } else {
    tail_ = derivative_tail(mask_);
  }
}

LocalPatch<Algebraic> C1Prover::patch(int n) const { return patch_of(scheme_, mask_, n); }

C1Certificate C1Prover::certify(int n) const {
  LocalPatch<Algebraic> around = patch(n);  // before: g++ 12 destroys a nested aggregate twice if a later part throws
  C1Certificate c{.verdict = {.property = "c1", .says = "C^1 at the extraordinary point"},
                  .map = {},
                  .proof = {},
                  .patch = std::move(around)};
  Verdict& v = c.verdict;
  v.theorem =
      "Reif 1995: where 1 and then one real pair lead the spectrum, and the characteristic map of the pair is regular "
      "and "
      "injective, limits of generic data are C^1. Injective by its degree: no fold, one turn around the centre";
  const auto add = [&](std::string says, std::optional<bool> holds, By by, std::string value = {}) {
    v.hypotheses.push_back({std::move(says), holds, by, std::move(value)});
  };
  v.hypotheses.push_back(rows_sum_to_one(c.patch));
  // Neither this nor the sign of lambda is necessary: other theorems speak of other pairs.
  add("it commutes with the rotation by a sector",
      exact_rows(c.patch.A, c.patch.orbits) ? std::optional(true) : std::nullopt, By::exact);
  const DenseMatrix<ComplexBall> B1 = fourier_block(c.patch, 1);
  const auto pair = leading_pair(B1);
  add("block 1 has an isolated leading eigenvalue", pair ? std::optional(true) : std::nullopt, By::enclosure,
      pair ? "lambda in " + pair->value.re().text() : "");
  if (pair) {
    const Dominance d = dominance(c.patch, *pair, B1);
    const Ball lambda = pair->value.re();
    add("all other eigenvalues but 1 are smaller, so 1 is simple and lambda belongs to blocks 1 and n - 1 alone",
        d.open ? std::nullopt : std::optional(true), By::enclosure,
        d.open ? "not shown for block " + std::to_string(*d.open) : "norms of powers up to " + std::to_string(d.power));
    add("lambda is real: block 1 is similar to its conjugate by reflection",
        mirror_rows(c.patch) ? std::optional(true) : std::nullopt, By::exact);
    add("0 < lambda < 1",
        certainly_positive(lambda) && certainly_less(lambda, Ball(1)) ? std::optional(true) : std::nullopt,
        By::enclosure);
    c.map = characteristic_map(c.patch, mask_, *pair);
    c.map->lambda = ComplexBall(lambda);
  }
  // What the map of another pair looks like says nothing.
  const bool leads = holds_for_all(v.hypotheses, [](const Hypothesis& h) { return h.holds; }) == true;
  if (!c.map) return v.answer = answer_of(v.hypotheses, true), c;
  if (!pieces_ && !tail_) return add_evidence(c, leads), c;
  if (pieces_)
    add("points of regular meshes converge: weights are not negative and all points of a piece share a parent",
        converges_ ? std::optional(true) : std::nullopt, By::exact);
  if (pieces_)
    add("the regular limit consists of polynomials and is C^1", pieces_->continuity >= 1, By::exact,
        "C^" + std::to_string(pieces_->continuity) + ", degree " + std::to_string(pieces_->degree));
  else
    add("the regular limit is C^1: second differences shrink faster than steps", true, By::enclosure,
        tail_->contraction.text(6) + " in " + std::to_string(tail_->steps) + " steps");
  const auto ring = regular_ring(c.patch, pieces_ ? *pieces_ : tail_->pieces);
  add("from some ring on the neighbourhood is regular", ring ? std::optional(true) : std::nullopt, By::exact,
      ring ? "ring " + std::to_string(*ring) : "");
  if (ring && leads) {
    c.proof = pieces_ ? prove_map(*c.map, *pieces_, functions_, *ring) : prove_map(*c.map, *tail_, *ring, net_levels);
    const MapProof& p = *c.proof;
    const bool known = p.regular != MapProof::Regular::unknown;
    add("the Jacobian determinant of the characteristic map is positive",
        known ? std::optional(p.regular == MapProof::Regular::yes) : std::nullopt, By::enclosure,
        p.regular == MapProof::Regular::folds ? "negative in " + p.fold
        : p.regular == MapProof::Regular::yes
            ? "at least " + rounded_down(p.least) + " on " + std::to_string(p.parts) + " parts"
            : "");
    add("its boundary curve winds once around the centre", p.winds_once ? std::optional(true) : std::nullopt,
        By::enclosure);
  }
  v.answer = answer_of(v.hypotheses, /*necessary=*/true);
  if (v.answer == Verdict::Answer::unknown && leads && !pieces_) add_evidence(c, leads);
  return c;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/spectral_verdicts.h"

#include <algorithm>
#include <set>

#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;
using Answer = Verdict::Answer;

std::string text_of(const ExactEigenvalue& value) {
  std::string text = value.value.text();
  if (value.block >= 0) text += " in block " + std::to_string(value.block);
  if (value.largest_jordan() > 1) text += ", Jordan block of size " + std::to_string(value.largest_jordan());
  return text;
}

std::string text_of(const std::vector<ExactEigenvalue>& values) {
  std::string all;
  for (const ExactEigenvalue& value : values) all += (all.empty() ? "" : "; ") + text_of(value);
  return all;
}

Hypothesis one_dominates(const ExactAnalysis& analysis) {
  const std::vector<ExactEigenvalue> first = analysis.spectrum.of_rank(0);
  Hypothesis h{"eigenvalue 1 is simple and larger than all others in modulus", std::nullopt, By::enclosure,
               text_of(first)};
  if (!first.empty())
    h.holds = first.size() == 1 && first[0].multiplicity == 1 && first[0].value == AlgebraicRoot(Algebraic(1));
  if (analysis.spectrum.num_ranks() > 1) h.value += ", then " + text_of(analysis.spectrum.of_rank(1));
  return h;
}

/// Why powers of the local matrix do not tend to one point.
std::string divergence(const Hypothesis& rows, const Hypothesis& dominates, const ExactAnalysis& analysis) {
  if (rows.holds == false) return "the weights of a new point do not sum to 1 (" + rows.value + ")";
  for (const ExactEigenvalue& value : analysis.spectrum.of_rank(0))
    if (compare_moduli(value.value, AlgebraicRoot(Algebraic(1))) > 0)
      return "an eigenvalue is larger than 1 in modulus, " + text_of(value) + ": points run away from one another";
  return "the leading eigenvalues are " + dominates.value;
}

bool is_positive(const AlgebraicRoot& root) { return root.is_real() && compare(root, AlgebraicRoot(Algebraic(0))) > 0; }

}  // namespace

Hypothesis rows_sum_to_one(const LocalPatch<Algebraic>& patch) {
  const DenseMatrix<Algebraic>& A = patch.A;
  ForAll rows;
  for (Eigen::Index i = 0; i < A.rows() && rows.holds() != false; ++i) {
    Algebraic sum;
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (!A(i, j).is_zero()) sum += A(i, j);
    rows.look(sum.is_one(), "point " + std::to_string(i) + ": " + sum.text());
  }
  return {"the weights of every new point sum to 1", rows.holds(), By::exact, rows.where()};
}

Verdict affine_invariance(const ExactAnalysis& analysis) {
  Verdict v{"affine-invariance", "affine maps commute with refinement"};
  v.theorem = "a sum of points moves with an affine map if and only if its weights sum to 1";
  v.hypotheses = {rows_sum_to_one(analysis.patch)};
  v.answer = answer_of(v.hypotheses, true);
  v.because = v.hypotheses[0].holds == true ? "every row of the local matrix sums to 1 exactly"
              : v.hypotheses[0].holds       ? "a row of the local matrix does not sum to 1: " + v.hypotheses[0].value
                                            : "the local matrix has no rows";
  return v;
}

Verdict convergence(const ExactAnalysis& analysis) {
  Verdict v{"convergence", "points around the centre converge to one point, which moves with them"};
  v.theorem =
      "powers of a matrix with row sums 1 tend to a matrix of rank 1 if and only if 1 is a simple eigenvalue "
      "and the only one of modulus 1 or more";
  v.hypotheses = {rows_sum_to_one(analysis.patch), one_dominates(analysis)};
  v.answer = answer_of(v.hypotheses, true);
  v.because =
      v.answer == Answer::proved ? "1 is simple and dominant" : divergence(v.hypotheses[0], v.hypotheses[1], analysis);
  return v;
}

Verdict spectral_c1(const ExactAnalysis& analysis) {
  Verdict v{"c1", "C^1 at the extraordinary point"};
  v.theorem =
      "Reif 1995, A unified approach to subdivision algorithms near extraordinary vertices; Peters, Reif 1998 "
      "for symmetric schemes";
  v.hypotheses = {rows_sum_to_one(analysis.patch), one_dominates(analysis)};
  if (answer_of(v.hypotheses, true) == Answer::disproved) {
    v.answer = Answer::disproved;
    v.because = "there is no limit: " + divergence(v.hypotheses[0], v.hypotheses[1], analysis);
    return v;
  }
  const std::vector<ExactEigenvalue> lead = analysis.spectrum.of_rank(1);
  Hypothesis real{"the next modulus belongs to one real, positive eigenvalue lambda", !lead.empty(), By::exact,
                  text_of(lead)};
  Hypothesis pair{"lambda is simple in blocks 1 and n-1, and no other block has an eigenvalue of its modulus", true,
                  By::exact, text_of(lead)};
  Hypothesis diagonal{"lambda has no Jordan block larger than 1", true, By::exact};
  int longest = 0, other = -1;
  for (const ExactEigenvalue& value : lead) {
    longest = std::max(longest, value.largest_jordan());
    real.holds = *real.holds && is_positive(value.value) && value.value == lead[0].value;
    pair.holds = *pair.holds && value.block == 1 && value.multiplicity == 1;
  }
  diagonal.holds = longest == 1;
  diagonal.value = "largest block " + std::to_string(longest);
  v.hypotheses.insert(v.hypotheses.end(), {real, pair, diagonal});
  if (*real.holds && *pair.holds && *diagonal.holds) {
    v.because = "lambda = " + lead[0].value.text() + " leads, from blocks 1 and n-1 alone";
    return v;  // the map decides
  }
  // Longest Jordan chains of the largest modulus lead.
  bool block_one = false, block_one_twice = false;
  std::optional<bool> seen = true;
  for (const ExactEigenvalue& value : lead) {
    if (value.largest_jordan() < longest) continue;
    if (value.value == AlgebraicRoot()) break;  // modes of eigenvalue 0 are gone after a step
    if (value.block == 1) {
      block_one_twice = block_one || std::count(value.jordan.begin(), value.jordan.end(), longest) > 1;
      block_one = true;
      continue;
    }
    if (const std::optional<bool> it = is_seen(analysis, value); other < 0 || it == true) {
      other = value.block;
      seen = it;
    }
  }
  const std::string chains =
      longest > 1 ? "Jordan chains of length " + std::to_string(longest) : std::string("eigenvalues");
  if (other >= 0) {
    v.hypotheses.push_back({"the leading mode of block " + std::to_string(other) + " is not zero at a regular point",
                            seen, By::enclosure});
    // A mode of this block leads for generic data: with one of block 1 there are more than two directions, without one
    // the surface does not wind around the point once.
    if (seen == true) v.answer = Answer::disproved;
    if (block_one)
      v.because = "blocks 1 and " + std::to_string(other) + " lead together (" + text_of(lead) +
                  "): three directions or more, no tangent plane";
    else if (2 * other == analysis.n())
      v.because =
          "block " + std::to_string(other) + " leads (" + text_of(lead) + "): one direction alone, no tangent plane";
    else if (other == 0)
      v.because = "block 0 leads (" + text_of(lead) + ", by " + chains + "): a spike, no tangent plane";
    else
      v.because = "block " + std::to_string(other) + " leads (" + text_of(lead) + "): the surface winds " +
                  std::to_string(other) + " times around the point";
  } else if (longest > 1 && block_one && !block_one_twice) {
    v.answer = Answer::borderline;
    v.because = "the Jordan case: " + text_of(lead) +
                "; the longest chain is that of blocks 1 and n-1, so the tangent "
                "plane is reached, like 1/steps, where the map of its top vector allows";
  } else {
    v.because = "the criterion does not speak of this spectrum: " + text_of(lead);
  }
  return v;
}

std::optional<Subdominant> subdominant(const ExactAnalysis& analysis) {
  const std::vector<ExactEigenvalue> lead = analysis.spectrum.of_rank(1);
  if (one_dominates(analysis).holds != true || lead.size() != 1 || lead[0].block != 1 || lead[0].multiplicity != 1 ||
      !is_positive(lead[0].value) || analysis.spectrum.num_ranks() < 3)
    return std::nullopt;
  Subdominant s;
  s.lambda = lead[0];
  s.mu = analysis.spectrum.of_rank(2);
  const PrecisionScope scope(128);
  const Ball lambda = s.lambda.value.real_enclosure(), square = lambda * lambda, mu = abs(s.mu[0].value.enclosure());
  // Balls first: the polynomial of lambda^2 has roots that are long to find, and only an equality needs them.
  s.mu_to_lambda2 = certainly_less(mu, square)   ? -1
                    : certainly_less(square, mu) ? 1
                                                 : compare_moduli(s.mu[0].value, s.lambda.value.squared());
  s.ratio = s.mu_to_lambda2 == 0 ? Ball(1) : mu / square;
  std::set<int> blocks;
  for (const ExactEigenvalue& value : s.mu) {
    s.largest_jordan = std::max(s.largest_jordan, value.largest_jordan());
    blocks.insert(value.block);
    if (value.copies == 2) blocks.insert(analysis.n() - value.block);
  }
  s.mu_blocks.assign(blocks.begin(), blocks.end());
  return s;
}

}  // namespace sublimit

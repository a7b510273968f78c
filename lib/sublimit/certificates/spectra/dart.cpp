// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/dart.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;
using Answer = Verdict::Answer;

/// Eigenvalues of one block, by modulus, but for the eigenvalue 1 of block 0.
std::vector<ExactEigenvalue> modes_of(const ExactSpectrum& spectrum, int block) {
  std::vector<ExactEigenvalue> modes;
  for (const ExactEigenvalue& value : spectrum.values)
    if (value.block == block && value.rank > 0) modes.push_back(value);
  return modes;
}

bool is_positive(const AlgebraicRoot& root) { return root.is_real() && compare(root, AlgebraicRoot(Algebraic(0))) > 0; }

/// Polynomials of high degree tell nobody anything.
std::string short_text(const AlgebraicRoot& root) {
  const std::string text = root.text();
  return text.size() <= 40 ? text : root.enclosure().re().text(12);
}

/// Sums of the absolute weights that points of the wider patch which are not in the smaller one have on such points: no
/// eigenvalue that these points add is larger in modulus than all of these sums.
std::vector<Ball> outer_sums(const LocalPatch<Algebraic>& wider, const LocalPatch<Algebraic>& smaller) {
  std::vector<Index> outer;
  for (size_t i = 0; i < wider.slots.size(); ++i)
    if (!std::binary_search(smaller.slots.begin(), smaller.slots.end(), wider.slots[i]))
      outer.push_back(static_cast<Index>(i));
  std::vector<Ball> sums;
  for (const Index i : outer) {
    Ball sum(0);
    for (const Index j : outer)
      if (const Algebraic& w = wider.A(i, j); !w.is_zero()) sum += abs(w.real_enclosure());
    sums.push_back(sum);
  }
  return sums;
}

bool adds_smaller(const ExactAnalysis& analysis, const AlgebraicRoot& value) {
  const auto wider = dart_patch(analysis.scheme, analysis.patch.type.faces, 2);
  if (!wider) return false;
  const std::vector<Ball> sums = outer_sums(*wider, analysis.patch);
  const Ball bound = value.real_enclosure();
  return holds_for_all(sums, [&](const Ball& sum) { return certainly_less(sum, bound); }) == true;
}

}  // namespace

bool is_same_matrix(const LocalPatch<Algebraic>& a, const LocalPatch<Algebraic>& b) {
  if (a.labels != b.labels || a.A.rows() != b.A.rows()) return false;
  for (Eigen::Index i = 0; i < a.A.size(); ++i)
    if (!(a.A.data()[i] == b.A.data()[i])) return false;
  return true;
}

ExactAnalysis open_analysis(const Scheme<Algebraic>& scheme, LocalPatch<Algebraic> patch) {
  ExactAnalysis analysis;
  analysis.scheme = scheme;
  analysis.patch = std::move(patch);
  analysis.spectrum = exact_spectrum(analysis.patch);
  return analysis;
}

Verdict dart_tangent_plane(const ExactAnalysis& analysis) {
  Verdict v{"tangent-plane", "one tangent plane around the dart"};
  v.theorem =
      "for generic data, by the order of modes: the Jacobian of a map of two modes of one kind, even or odd, changes "
      "its "
      "sign at the mirror, so normals tend to one limit only if one even and one odd mode lead (an argument, not a "
      "published theorem)";
  const ExactSpectrum& spectrum = analysis.spectrum;
  const std::vector<ExactEigenvalue> first = spectrum.of_rank(0);
  v.hypotheses = {{"the neighbourhood is its own mirror image", spectrum.blocks.blocks.size() == 2, By::exact},
                  {"eigenvalue 1 is simple and larger than all others in modulus",
                   first.size() == 1 && first[0].multiplicity == 1 && first[0].value == AlgebraicRoot(Algebraic(1)),
                   By::exact, first.empty() ? "" : first[0].value.text()}};
  for (const Hypothesis& h : v.hypotheses)
    if (h.holds != true) {
      v.because = "the argument does not speak of this: that " + h.says + " does not hold";
      return v;
    }
  const std::vector<ExactEigenvalue> even = modes_of(spectrum, 0), odd = modes_of(spectrum, 1);
  if (even.empty() || odd.empty()) {
    v.because = even.empty() ? "there are no even modes but the constants" : "there are no odd modes";
    return v;
  }
  const ExactEigenvalue &e = even[0], &o = odd[0];
  const std::string pair = "even " + short_text(e.value) + ", odd " + short_text(o.value);
  const bool positive = is_positive(e.value) && is_positive(o.value), simple = e.multiplicity + o.multiplicity == 2;
  v.hypotheses.push_back(
      {"the first even and the first odd mode have real, positive eigenvalues", positive, By::exact, pair});
  v.hypotheses.push_back(
      {"both eigenvalues are simple in their block", simple, By::exact,
       "multiplicities " + std::to_string(e.multiplicity) + " and " + std::to_string(o.multiplicity)});
  if (!positive || !simple) {
    v.because = "the argument does not speak of this spectrum: " + pair;
    if (positive && e.value == o.value && e.largest_jordan() == 1 && o.largest_jordan() == 1) {
      v.answer = Answer::disproved;
      v.because = "three directions or more lead together (" + pair + "), no tangent plane";
    }
    return v;
  }
  // The second mode of the larger one's kind must not lead with it.
  const bool is_odd = compare_moduli(e.value, o.value) < 0;
  const std::vector<ExactEigenvalue>& kind = is_odd ? odd : even;
  const AlgebraicRoot& slower = is_odd ? e.value : o.value;
  const AlgebraicRoot rival = kind.size() > 1 ? kind[1].value : AlgebraicRoot(Algebraic(0));
  const std::string name = is_odd ? "odd" : "even";
  const int order = compare_moduli(rival, slower);
  v.hypotheses.push_back({"the second " + name + " mode is smaller than both", order < 0,
                          order == 0 ? By::exact : By::enclosure,
                          short_text(rival) + " against " + short_text(slower)});
  if (order > 0) {
    v.answer = Answer::disproved;
    v.because = "two " + name + " modes lead: the surface folds at its mirror";
  } else if (order == 0) {
    v.answer = Answer::disproved;
    v.because = "three modes lead together, in two blocks: normals around the point have no one limit";
  } else {
    v.answer = Answer::evidence_for;
    v.hypotheses.push_back({"points of the second ring add smaller eigenvalues only",
                            adds_smaller(analysis, slower) ? std::optional(true) : std::nullopt, By::enclosure,
                            "sums of their absolute weights"});
    v.hypotheses.push_back({"the map of the two leading modes is regular and injective", std::nullopt, By::exact});
    v.because = "one even and one odd mode lead: " + pair;
  }
  return v;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
// Second order: how mu, the modulus after lambda, compares with lambda^2, and which blocks carry it.
#include <algorithm>
#include <charconv>

#include "sublimit/certificates/spectra/for_all.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;
using Answer = Verdict::Answer;

std::string list(const std::vector<int>& blocks) {
  std::string all;
  for (const int k : blocks) all += (all.empty() ? "" : ", ") + std::to_string(k);
  return all;
}

/// That one of some modes is not zero everywhere in the limit.
template <class Which>
Hypothesis seen(const ExactAnalysis& analysis, const std::vector<ExactEigenvalue>& values, const Which& which) {
  Hypothesis h{"a mode of mu is not zero at a regular point", std::nullopt, By::enclosure};
  for (const ExactEigenvalue& value : values)
    if (!h.holds && which(value) && is_seen(analysis, value) == true) {
      h.holds = true;
      h.value = "block " + std::to_string(value.block);
    }
  return h;
}

/// The hypotheses that all of these share; false where there is nothing more to say.
bool begin(Verdict& v, const std::optional<Subdominant>& s, const ExactAnalysis& analysis,
           const SecondOrderGiven& given) {
  v.hypotheses = {given.c1};
  v.hypotheses.push_back({"lambda is real, positive and simple in blocks 1 and n-1 and alone in its modulus",
                          s.has_value(), By::exact, s ? s->lambda.value.text() : ""});
  if (!s) {
    v.because = "the leading modes are not those of a tangent plane";
    return false;
  }
  const char* relation = s->mu_to_lambda2 < 0 ? "smaller than" : s->mu_to_lambda2 > 0 ? "larger than" : "equal to";
  v.hypotheses.push_back({std::string("mu, the next modulus, is ") + relation + " lambda^2", true,
                          s->mu_to_lambda2 == 0 ? By::exact : By::enclosure,
                          "mu = " + s->mu[0].value.text() + ", mu/lambda^2 = " + s->ratio.text()});
  v.hypotheses.push_back(
      seen(analysis, s->mu, [&](const ExactEigenvalue& value) { return value.largest_jordan() == s->largest_jordan; }));
  return true;
}

std::string shortest(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

}  // namespace

Verdict curvature(const ExactAnalysis& analysis, const SecondOrderGiven& given) {
  Verdict v{"curvature", "how curvature behaves near the extraordinary point"};
  v.theorem =
      "near the point curvatures behave like (mu/lambda^2)^m after m steps, like m^(j-1) times that where mu has "
      "a Jordan block of size j: Doo, Sabin 1978; Peters, Reif 2008, Subdivision Surfaces";
  const std::optional<Subdominant> s = subdominant(analysis);
  if (!begin(v, s, analysis, given)) return v;
  std::string how = s->mu_to_lambda2 < 0 ? "flat" : s->mu_to_lambda2 > 0 ? "divergent" : "bounded";
  if (s->mu_to_lambda2 == 0) {
    v.hypotheses.push_back({s->largest_jordan == 1 ? "mu is semisimple" : "mu is defective", true, By::exact,
                            "largest Jordan block " + std::to_string(s->largest_jordan)});
    if (s->largest_jordan > 1) how = "logarithmic";
  }
  if (how != "divergent") v.hypotheses.push_back(given.bounded);
  v.says = how == "flat"          ? "curvature tends to zero at the extraordinary point"
           : how == "bounded"     ? "curvature stays bounded near the extraordinary point"
           : how == "logarithmic" ? "curvature grows like a logarithm at the extraordinary point"
                                  : "curvature diverges at the extraordinary point";
  v.answer = answer_of(v.hypotheses, false);
  v.because = "mu/lambda^2 = " + s->ratio.text() + ", from blocks " + list(s->mu_blocks) +
              (s->largest_jordan > 1 ? ", with a Jordan block of size " + std::to_string(s->largest_jordan) : "");
  v.findings = {{"curvature", how}};
  return v;
}

Verdict shapes(const ExactAnalysis& analysis, const SecondOrderGiven& given) {
  Verdict v{"shapes", "which shapes there are near the extraordinary point"};
  v.theorem = "Karciauskas, Peters, Reif 2004, Shape characterization of subdivision surfaces";
  const std::optional<Subdominant> s = subdominant(analysis);
  if (!begin(v, s, analysis, given)) return v;
  // Longer chains win among equals.
  std::vector<int> blocks;
  ForAll all_seen;
  for (const ExactEigenvalue& value : s->mu) {
    if (value.largest_jordan() < s->largest_jordan) continue;
    blocks.push_back(value.block);
    if (value.copies == 2) blocks.push_back(analysis.n() - value.block);  // at n = 3 block 1 stands for block 2 too
    if (all_seen.looked_at() == 0 || all_seen.holds() == true) all_seen.look(is_seen(analysis, value));
  }
  std::sort(blocks.begin(), blocks.end());
  const int n = analysis.n();
  const auto has = [&](int k) { return std::count(blocks.begin(), blocks.end(), k) > 0; };
  const bool only = holds_for_all(blocks, [&](int k) { return k == 0 || k == 2 || k == n - 2; }) == true;
  const std::string which = has(0) && has(2) ? "all" : !only ? "other" : has(0) ? "elliptic" : "hyperbolic";
  v.hypotheses.push_back(
      {"the modes of mu with the longest chains are those of blocks " + list(blocks), true, By::exact});
  v.hypotheses.push_back({"each of these blocks has a mode that is not zero at a regular point",
                          all_seen.holds() == true ? std::optional(true) : std::nullopt, By::enclosure});
  // Blocks exclude: a mode without block 0 has both signs, one of block 0 alone turns its gradient the right way round.
  // Whether a mode of block 0 is convex they do not tell.
  v.says = which == "all"          ? "neither elliptic nor hyperbolic shapes are excluded near the point"
           : which == "elliptic"   ? "no hyperbolic shapes near the point"
           : which == "hyperbolic" ? "no elliptic shapes near the point"
                                   : "shapes of other kinds near the point";
  v.answer = answer_of(v.hypotheses, false);
  v.because = "mu comes from blocks " + list(s->mu_blocks);
  v.findings = {{"shapes", which}};
  return v;
}

Verdict curvature_integrability(const ExactAnalysis& analysis, const SecondOrderGiven& given) {
  Verdict v{"curvature-integrability", "principal curvatures are in L^p near the point for every p"};
  v.theorem = "Reif, Schroeder 2001, Curvature integrability of subdivision surfaces";
  const std::optional<Subdominant> s = subdominant(analysis);
  if (!begin(v, s, analysis, given)) return v;
  v.hypotheses.push_back(given.bounded);
  v.answer = answer_of(v.hypotheses, false);
  if (s->mu_to_lambda2 <= 0) {
    v.because = "mu is not larger than lambda^2";
    v.findings = {{"p", "null"}};
    return v;
  }
  const PrecisionScope scope(128);
  const Ball lambda = Ball(2) * log(s->lambda.value.real_enclosure()), mu = log(abs(s->mu[0].value.enclosure()));
  const Ball p = lambda / (lambda - mu);
  v.says = "principal curvatures are in L^p near the point exactly for p < " + p.text(6);
  v.because = "p < 2 ln lambda/(2 ln lambda - ln mu) = " + p.text();
  v.findings = {{"p", shortest(p.mid())}};
  return v;
}

Verdict spectral_c2(const ExactAnalysis& analysis, const SecondOrderGiven& given) {
  Verdict v{"c2", "C^2 at the extraordinary point"};
  v.theorem =
      "C^2 with shapes of any curvature asks for mu = lambda^2, semisimple, from blocks 0, 2 and n-2 alone, with "
      "modes that are quadratic polynomials of the characteristic map: Prautzsch 1998; Zorin 2000";
  const std::optional<Subdominant> s = subdominant(analysis);
  if (!begin(v, s, analysis, given)) return v;
  const int n = analysis.n();
  const auto is_quadratic = [&](int k) { return k == 0 || k == 2 || k == n - 2; };
  const bool blocks = std::all_of(s->mu_blocks.begin(), s->mu_blocks.end(), is_quadratic);
  v.hypotheses.push_back(given.continuous);
  if (s->mu_to_lambda2 < 0) {
    v.says = "C^2 at the extraordinary point, which is flat";
    v.answer = answer_of(v.hypotheses, false);
    v.because = "mu < lambda^2: second derivatives tend to zero";
    return v;
  }
  v.hypotheses.push_back(
      {"mu = lambda^2", s->mu_to_lambda2 == 0, s->mu_to_lambda2 == 0 ? By::exact : By::enclosure, s->ratio.text()});
  v.hypotheses.push_back({"mu comes from blocks 0, 2 and n-2 alone", blocks, By::exact, list(s->mu_blocks)});
  v.hypotheses.push_back({"mu is semisimple", s->largest_jordan == 1, By::exact});
  if (s->mu_to_lambda2 > 0 || !blocks || s->largest_jordan > 1) {
    // Each is necessary, whatever else is open, once the mode that offends is there to be seen.
    const Hypothesis offends = seen(analysis, s->mu, [&](const ExactEigenvalue& value) {
      return s->mu_to_lambda2 > 0 || !is_quadratic(value.block) || value.largest_jordan() > 1;
    });
    v.answer = offends.holds == true ? Answer::disproved : Answer::unknown;
    v.because = s->mu_to_lambda2 > 0 ? "mu > lambda^2: curvature diverges"
                : !blocks            ? "mu comes from blocks " + list(s->mu_blocks)
                                     : "mu has a Jordan block of size " + std::to_string(s->largest_jordan);
    return v;
  }
  v.hypotheses.push_back(
      {"the modes of mu are quadratic polynomials of the characteristic map", std::nullopt, By::exact});
  v.because =
      "the necessary conditions hold; whether the modes of mu are quadratic polynomials of the characteristic map "
      "is not looked at";
  return v;
}

}  // namespace sublimit

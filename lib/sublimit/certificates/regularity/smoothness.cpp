// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/smoothness.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"

namespace sublimit {
namespace {

std::string power(int dilation, int k) { return std::to_string(dilation) + "^-" + std::to_string(k); }

std::string text(double low, double high) {
  return low == high ? format_number(low) : "[" + format_number(low) + ", " + format_number(high) + "]";
}
Hypothesis::By by(const Ball& value) {
  return value.lower() == value.upper() ? Hypothesis::By::exact : Hypothesis::By::enclosure;
}

std::string word(const std::vector<int>& product) {
  std::string digits;
  for (const int i : product) digits += std::to_string(i);
  return digits;
}

/// dilation^-k
Ball inverse_power(int dilation, int k) {
  Ball scale(dilation);
  arb_pow_ui(scale.get(), scale.get(), static_cast<ulong>(k), PrecisionScope::bits());
  return Ball(1) / scale;
}

Verdict proved(const Smoothness& s, const DifferenceTransitions& t, int k, int sum_rules) {
  Verdict verdict{.property = "regular-smoothness", .says = "C^" + std::to_string(k)};
  verdict.hypotheses.push_back({"differences of order " + std::to_string(k + 1) +
                                    " have a scheme (polynomials up to degree " + std::to_string(k) + " are generated)",
                                sum_rules > k, Hypothesis::By::exact, std::to_string(sum_rules) + " sum rules"});
  const auto norm = std::find_if(s.norms.begin(), s.norms.end(),
                                 [&](const DifferenceNorm& n) { return n.order == k + 1 && n.norm.upper() < 1; });
  if (norm != s.norms.end()) {
    verdict.theorem =
        "Dyn 1992, Subdivision schemes in computer-aided geometric design, theorem 3.4: if differences of the divided "
        "differences of order k shrink, "
        "the limit is C^k";
    verdict.hypotheses.push_back({"the norm of " + std::to_string(norm->steps) +
                                      (norm->steps == 1 ? " step" : " steps") +
                                      " of the scheme of differences of order " + std::to_string(k + 1) + " is below 1",
                                  true, by(norm->norm), text(norm->norm.lower(), norm->norm.upper())});
    verdict.because = "after " + std::to_string(norm->steps) + (norm->steps == 1 ? " step" : " steps") +
                      " differences of the divided differences of order " + std::to_string(k) + " are at most " +
                      format_number(norm->norm.upper()) + " times as large";
  } else {
    verdict.theorem =
        "Rioul 1992, Simple regularity criteria for subdivision schemes; Jia 1995, Subdivision schemes in L_p spaces: "
        "the limit "
        "is C^k if the joint spectral radius of differences of order above k is below dilation^-k";
    verdict.hypotheses.push_back({"the joint spectral radius of differences of order " + std::to_string(t.order) +
                                      " is below " + power(t.dilation, k),
                                  s.radius.high < inverse_power(t.dilation, k).lower(), Hypothesis::By::enclosure,
                                  text(s.radius.low, s.radius.high)});
    verdict.because = "differences of order " + std::to_string(t.order) + " shrink by " + format_number(s.radius.high) +
                      " a step, faster than " + power(t.dilation, k);
  }
  verdict.answer = answer_of(verdict.hypotheses, false);
  return verdict;
}

/// C^k is impossible, if it is shown to be: nothing else.
std::optional<Verdict> disproved(const Smoothness& s, const DifferenceTransitions& t, int k, int sum_rules) {
  Verdict verdict{
      .property = "regular-smoothness", .says = "C^" + std::to_string(k), .answer = Verdict::Answer::disproved};
  verdict.hypotheses.push_back({t.necessary_because, t.necessary, Hypothesis::By::exact});
  if (!t.necessary) return std::nullopt;
  if (sum_rules <= k && t.stable) {
    verdict.theorem =
        "Cavaretta, Dahmen, Micchelli 1991, Stationary subdivision, theorem 8.4: where the limit is C^k, polynomials "
        "of degree k are generated";
    verdict.hypotheses.push_back({"polynomials of degree " + std::to_string(k) + " are generated", false,
                                  Hypothesis::By::exact, std::to_string(sum_rules) + " sum rules"});
    verdict.because = "the masks do not generate the polynomials of degree " + std::to_string(k);
    return verdict;
  }
  verdict.theorem =
      "where the limit is C^k, divided differences of order k converge, and products of the matrices of higher "
      "differences, times "
      "dilation^k a step, tend to zero (Daubechies, Lagarias 1992, Two-scale difference equations II)";
  // Differences of order m of functions smoother than that shrink like dilation^-m, no faster.
  const bool beyond = k >= t.order;
  const double bound = inverse_power(t.dilation, std::min(k, t.order)).upper();
  if (beyond ? s.radius.low > bound : s.radius.low >= bound) {
    verdict.hypotheses.push_back(
        {"the spectral radius of every product of the matrices is below " + power(t.dilation, k) + " a step", false,
         Hypothesis::By::enclosure,
         "product " + word(s.radius.product) + ": at least " + format_number(s.radius.low) + " a step"});
    verdict.because = "differences of order " + std::to_string(t.order) + " can shrink as slowly as " +
                      format_number(s.radius.low) + " a step, and " + power(t.dilation, k) + " is too slow for C^" +
                      std::to_string(k);
    return verdict;
  }
  if (beyond) return std::nullopt;
  Rational factor = 1;
  for (int i = 0; i < k; ++i) factor *= t.dilation;
  for (size_t i = 0; i < t.matrices.size(); ++i) {
    if (!has_unit_eigenvalue(t.matrices[i], factor)) continue;
    verdict.hypotheses.push_back(
        {"the spectral radius of every product of the matrices is below " + power(t.dilation, k) + " a step", false,
         Hypothesis::By::exact, "matrix " + std::to_string(i) + " has the eigenvalue +-" + power(t.dilation, k)});
    verdict.because = "beyond the polynomials of degree " + std::to_string(t.order - 1) +
                      " there is another eigenvalue of modulus " + power(t.dilation, k) + ": differences of order " +
                      std::to_string(k) + ", divided, do not converge";
    return verdict;
  }
  return std::nullopt;
}

}  // namespace

bool has_unit_eigenvalue(const RationalMatrix& A, const Rational& factor) {
  for (const int sign : {1, -1}) {
    RationalMatrix M = A * factor;
    for (Eigen::Index i = 0; i < M.rows(); ++i) M(i, i) -= sign;
    if (is_singular(M)) return true;
  }
  return false;
}

Ball exponent_of(double radius, int dilation) {
  Ball exponent;
  int binary = 0;
  if (radius <= 0)
    arb_pos_inf(exponent.get());
  else if (dilation == 2 && std::frexp(radius, &binary) == 0.5)
    exponent = Ball(1 - binary);
  else
    exponent = log(Ball(radius)) / -log(Ball(dilation));
  return exponent;
}

Smoothness smoothness(const DifferenceTransitions& transitions, const std::vector<DifferenceNorm>& norms, int sum_rules,
                      const JointSpectralRadiusOptions& options, const DifferenceTransitions* of_limits) {
  Smoothness s;
  s.norms = norms;
  s.order = transitions.order;
  std::vector<BallMatrix> matrices;
  for (const RationalMatrix& A : transitions.matrices) matrices.emplace_back(A);
  s.radius = joint_spectral_radius(matrices, options);
  const DifferenceTransitions& necessary = of_limits ? *of_limits : transitions;
  if (of_limits) {
    std::vector<BallMatrix> limits;
    for (const RationalMatrix& A : of_limits->matrices) limits.emplace_back(A);
    s.radius.low = product_radius(balanced(limits), s.radius.product);
  }
  const double exponent_low = exponent_of(s.radius.high, transitions.dilation).lower(),
               exponent_high = exponent_of(s.radius.low, transitions.dilation).upper();
  // Differences of this order see no exponent above it.
  s.exponent_low = std::min(exponent_low, static_cast<double>(transitions.order));
  // And of whatever is smooth they shrink like dilation^-order: there they give no bound from above, polynomials may.
  const bool is_seen = exponent_high < necessary.order;
  s.exponent_high = necessary.stable ? is_seen ? std::min(exponent_high, double(sum_rules)) : sum_rules : exponent_high;
  s.has_upper_bound = necessary.necessary && (is_seen || necessary.stable);
  const auto is_proved = [&](int k) {
    if (k >= sum_rules) return false;
    const bool by_norm = std::any_of(norms.begin(), norms.end(),
                                     [&](const DifferenceNorm& n) { return n.order == k + 1 && n.norm.upper() < 1; });
    return by_norm || (k < transitions.order && s.radius.high < inverse_power(transitions.dilation, k).lower());
  };
  while (is_proved(s.continuity + 1)) ++s.continuity;
  s.possible = s.continuity;
  std::optional<Verdict> no;
  for (int k = s.continuity + 1; k <= std::max(sum_rules, necessary.order) && !no; ++k) {
    no = disproved(s, necessary, k, sum_rules);
    if (!no) s.possible = k;
  }
  if (no && no->hypotheses.back().by == Hypothesis::By::exact)  // an eigenvalue of modulus dilation^-k, exactly
    s.exponent_high = std::min(s.exponent_high, static_cast<double>(s.possible + 1));
  if (s.continuity < 0) s.exponent_low = std::min(s.exponent_low, 0.0);
  if (s.continuity >= 0) {
    Verdict convergence = proved(s, transitions, 0, sum_rules);
    convergence.property = "convergence";
    convergence.says = "the levels converge uniformly to continuous limits";
    s.verdicts.push_back(std::move(convergence));
  }
  if (s.continuity > 0) s.verdicts.push_back(proved(s, transitions, s.continuity, sum_rules));
  if (no) s.verdicts.push_back(*no);
  if (s.possible > s.continuity)
    s.verdicts.push_back({.property = "regular-smoothness",
                          .says = "C^" + std::to_string(s.continuity + 1),
                          .answer = Verdict::Answer::unknown,
                          .because = "neither norms nor products decide it"});
  return s;
}

}  // namespace sublimit

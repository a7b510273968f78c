// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/smoothness.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"

namespace sublimit {
namespace {

std::string power(int dilation, int k) { return std::to_string(dilation) + "^-" + std::to_string(k); }

std::string text(const Interval& value) {
  return value.is_exact() ? format_number(value.low)
                          : "[" + format_number(value.low) + ", " + format_number(value.high) + "]";
}
Hypothesis::By by(const Interval& value) {
  return value.is_exact() ? Hypothesis::By::exact : Hypothesis::By::enclosure;
}

std::string word(const std::vector<int>& product) {
  std::string digits;
  for (const int i : product) digits += std::to_string(i);
  return digits;
}

/// dilation^-k, as an enclosure.
Interval inverse_power(int dilation, int k) {
  return quotient(1, std::pow(static_cast<double>(dilation), k));  // small powers of 2 and 3 are doubles
}

Verdict proved(const Smoothness& s, const DifferenceTransitions& t, int k, int sum_rules) {
  Verdict verdict{.property = "regular-smoothness", .says = "C^" + std::to_string(k)};
  verdict.hypotheses.push_back({"differences of order " + std::to_string(k + 1) +
                                    " have a scheme (polynomials up to degree " + std::to_string(k) + " are generated)",
                                sum_rules > k, Hypothesis::By::exact, std::to_string(sum_rules) + " sum rules"});
  const auto norm = std::find_if(s.norms.begin(), s.norms.end(),
                                 [&](const DifferenceNorm& n) { return n.order == k + 1 && n.norm.high < 1; });
  if (norm != s.norms.end()) {
    verdict.theorem =
        "Dyn 1992, Subdivision schemes in computer-aided geometric design, theorem 3.4: if differences of the divided "
        "differences of order k shrink, "
        "the limit is C^k";
    verdict.hypotheses.push_back({"the norm of " + std::to_string(norm->steps) +
                                      (norm->steps == 1 ? " step" : " steps") +
                                      " of the scheme of differences of order " + std::to_string(k + 1) + " is below 1",
                                  true, by(norm->norm), text(norm->norm)});
    verdict.because = "after " + std::to_string(norm->steps) + (norm->steps == 1 ? " step" : " steps") +
                      " differences of the divided differences of order " + std::to_string(k) + " are at most " +
                      format_number(norm->norm.high) + " times as large";
  } else {
    verdict.theorem =
        "Rioul 1992, Simple regularity criteria for subdivision schemes; Jia 1995, Subdivision schemes in L_p spaces: "
        "the limit "
        "is C^k if the joint spectral radius of differences of order above k is below dilation^-k";
    verdict.hypotheses.push_back({"the joint spectral radius of differences of order " + std::to_string(t.order) +
                                      " is below " + power(t.dilation, k),
                                  s.radius.high < inverse_power(t.dilation, k).low, Hypothesis::By::enclosure,
                                  text({s.radius.low, s.radius.high})});
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
  const Interval bound = inverse_power(t.dilation, std::min(k, t.order));
  if (beyond ? s.radius.low > bound.high : s.radius.low >= bound.high) {
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
    try {
      if (!has_unit_eigenvalue(t.matrices[i], factor)) continue;
    } catch (const AnalysisError&) {  // numbers too long: not decided
      continue;
    }
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
    // Gauss: singular or not, modulo nothing.
    RationalMatrix M = A;
    const Eigen::Index n = M.rows();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) M(i, j) = factor * M(i, j) - (i == j ? Rational(sign) : Rational(0));
    Eigen::Index rank = 0;
    for (Eigen::Index column = 0; column < n; ++column) {
      Eigen::Index pivot = rank;
      while (pivot < n && M(pivot, column).is_zero()) ++pivot;
      if (pivot == n) return true;
      M.row(rank).swap(M.row(pivot));
      for (Eigen::Index i = rank + 1; i < n; ++i) {
        if (M(i, column).is_zero()) continue;
        const Rational share = M(i, column) / M(rank, column);
        for (Eigen::Index j = column; j < n; ++j) M(i, j) -= share * M(rank, j);
      }
      ++rank;
    }
  }
  return false;
}

Interval exponent_of(const Interval& radius, int dilation) {
  const Interval l = log2(radius), d = log2(Interval(dilation));
  if (d.is_exact()) return {-l.high / d.low, -l.low / d.low};  // by 1
  // Exponents are positive where they matter.
  const auto below = [](double x) { return std::nextafter(std::nextafter(x, -INFINITY), -INFINITY); };
  const auto above = [](double x) { return std::nextafter(std::nextafter(x, INFINITY), INFINITY); };
  return {below(-l.high / (l.high < 0 ? d.high : d.low)), above(-l.low / (l.low < 0 ? d.low : d.high))};
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
  const Interval exponent = exponent_of({s.radius.low, s.radius.high}, transitions.dilation);
  // Differences of this order see no exponent above it.
  s.exponent_low = std::min(exponent.low, static_cast<double>(transitions.order));
  // And of whatever is smooth they shrink like dilation^-order: there they give no bound from above, polynomials may.
  const bool is_seen = exponent.high < necessary.order;
  s.exponent_high = necessary.stable ? is_seen ? std::min(exponent.high, double(sum_rules)) : sum_rules : exponent.high;
  s.has_upper_bound = necessary.necessary && (is_seen || necessary.stable);
  const auto is_proved = [&](int k) {
    if (k >= sum_rules) return false;
    const bool by_norm = std::any_of(norms.begin(), norms.end(),
                                     [&](const DifferenceNorm& n) { return n.order == k + 1 && n.norm.high < 1; });
    return by_norm || (k < transitions.order && s.radius.high < inverse_power(transitions.dilation, k).low);
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

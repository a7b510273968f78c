// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/curve_regularity.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/rational_schemes.h"
#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit {
namespace {

using Balls = std::vector<Ball>;

/// p(z) r(z^step).
Balls times_spread(const Balls& p, const Balls& r, size_t step) {
  Balls product(p.size() + step * (r.size() - 1));
  for (size_t j = 0; j < r.size(); ++j)
    for (size_t i = 0; i < p.size(); ++i)
      arb_addmul(product[i + step * j].get(), p[i].get(), r[j].get(), PrecisionScope::bits());
  return product;
}

/// Largest sum of moduli over a residue class.
Ball residue_norm(const Balls& p, size_t modulus) {
  Balls sums(modulus);
  for (size_t i = 0; i < p.size(); ++i) sums[i % modulus] += abs(p[i]);
  Ball largest;
  for (const Ball& s : sums) largest = max(largest, s);
  return largest;
}

/// The children of points stay where these are.
bool is_interpolatory(const Symbol& a) {
  bool others = false;
  for (int j = a.first; j <= a.last(); ++j) others |= j % 2 == 0 && j != 0 && !a.at(j).is_zero();
  return a.at(0) == 1 && !others && a.shift.is_zero();
}

PolynomialDegrees degrees_of(const Symbol& a, int sum_rules) {
  PolynomialDegrees degrees{.generates = sum_rules - 1};
  // sum_j a_j j (j-1) .. (j-k+1) = 2 s (s-1) .. (s-k+1), s the shift: Dyn, Hormann, Sabin, Shen 2008, "Polynomial
  // reproduction by symmetric subdivision schemes". Schemes of one sided masks have a shift of their own: what
  // reproduces lines.
  Rational first = 0;
  for (int j = a.first; j <= a.last(); ++j) first += a.at(j) * Rational(j);
  const Rational shift = first / 2;
  Rational right = 2;
  for (int k = 0; k < sum_rules; ++k) {
    Rational left = 0;
    for (int j = a.first; j <= a.last(); ++j) {
      Rational term = a.at(j);
      for (int i = 0; i < k; ++i) term *= Rational(j - i);
      left += term;
    }
    if (left != right) break;
    degrees.reproduces = k;
    right *= shift - Rational(k);
  }
  return degrees;
}

Verdict affine_invariance(const Symbol& a) {
  const Rational even = (value_at_one(a) + value_at_one(a, -1)) / 2, odd = value_at_one(a) - even;
  Verdict v{.property = "affine-invariance",
            .says = "new points move with the old ones under affine maps",
            .theorem = "affine combinations: the weights of each new point sum to 1",
            .hypotheses = {{"the even coefficients sum to 1", even == 1, Hypothesis::By::exact, to_string(even)},
                           {"the odd coefficients sum to 1", odd == 1, Hypothesis::By::exact, to_string(odd)}}};
  v.answer = answer_of(v.hypotheses, true);
  v.because =
      even == 1 && odd == 1 ? "both masks sum to 1" : "the masks sum to " + to_string(even) + " and " + to_string(odd);
  return v;
}

/// The values at the integers of a function with f(x) = sum c_j f(2x - j), scaled by `scale`; empty without a simple
/// eigenvalue 1.
std::vector<double> at_integers(const std::vector<double>& c, bool is_derivative) {
  const int n = static_cast<int>(c.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);  // f(i) = sum_j c_(2i-j) f(j), indices from the first coefficient on
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (2 * i - j >= 0 && 2 * i - j < n) M(i, j) = c[2 * i - j];
  M -= Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd system(n + 1, n);
  system.topRows(n) = M;
  for (int j = 0; j < n; ++j) system(n, j) = is_derivative ? -j : 1;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
  right[n] = 1;
  if (is_derivative) {  // and the values of the derivative sum to zero
    system.conservativeResize(n + 2, n);
    system.row(n + 1).setOnes();
    right.conservativeResize(n + 2);
    right[n + 1] = 0;
  }
  const Eigen::VectorXd f = system.colPivHouseholderQr().solve(right);
  if (!((system * f - right).norm() < 1e-9)) return {};
  return {f.data(), f.data() + n};
}

/// From the integers to all multiples of 2^-levels.
std::vector<double> refined(std::vector<double> f, const std::vector<double>& c, int levels) {
  const int n = static_cast<int>(c.size());
  for (int k = 0; k < levels; ++k) {
    const int step = 1 << k;  // f has the values at i/step
    std::vector<double> fine(2 * step * (n - 1) + 1, 0.0);
    for (int i = 0; i < static_cast<int>(fine.size()); ++i)
      for (int j = 0; j < n; ++j) {
        const int at = i - j * step;  // 2 x - j in units of 1/step, x = i/(2 step)
        if (at >= 0 && at < static_cast<int>(f.size())) fine[i] += c[j] * f[at];
      }
    f = std::move(fine);
  }
  return f;
}

std::vector<double> doubles(const Symbol& a, double factor) {
  std::vector<double> c;
  for (const Rational& x : a.coefficients) c.push_back(factor * x.value());
  return c;
}

/// The weights of a level's masks by index i - 2j.
std::map<Index, double> terms_at(const CurveScheme<double>& scheme, int level) {
  std::map<Index, double> terms;
  for (const int which : {0, 1}) {
    const Stencil<double> mask = scheme.masks.child(which)(CurveSite<double>(level));
    for (const auto& [slot, weight] : mask.terms()) terms[which - 2 * slot] = weight;
  }
  return terms;
}

/// Symbol of the level from which on masks do not change in double precision.
Symbol settled_symbol(const CurveScheme<double>& scheme) {
  for (int level = 1; level < 2000; level *= 2) {
    const std::map<Index, double> terms = terms_at(scheme, level);
    if (terms != terms_at(scheme, 2 * level)) continue;
    Symbol a;
    a.shift = scheme.masks.dual() ? Number<Rational>::ratio(1, 2) : Rational(0);
    a.first = terms.begin()->first;
    a.coefficients.resize(terms.rbegin()->first - a.first + 1);
    for (const auto& [power, weight] : terms) a.coefficients[power - a.first] = Rational(weight);
    return trimmed(std::move(a));
  }
  throw AnalysisError(scheme.name + ": the masks do not settle");
}

}  // namespace

DifferenceTransitions curve_transitions(const Symbol& a, int m) {
  const Symbol q = difference_symbol(a, m);
  // n differences in a row determine n + 1 of the next level: two windows.
  const int degree = static_cast<int>(q.coefficients.size()) - 1, n = std::max(1, degree);
  DifferenceTransitions t{.order = m};
  for (const int side : {0, 1}) {
    RationalMatrix A(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) A(i, j) = q.at(q.first + std::max(0, degree - 1) + side + i - 2 * j);
    t.matrices.push_back(std::move(A));
  }
  t.necessary = is_interpolatory(a);
  t.necessary_because = "old points stay, so differences of points are those of the limit";
  if (!t.necessary) {
    t.necessary = has_independent_shifts(a);
    t.necessary_because = "integer shifts of the basis function are linearly independent";
  }
  return t;
}

DifferenceNorm difference_norm(const Symbol& a, int order, int most_steps) {
  Symbol r = difference_symbol(a, order);
  for (Rational& c : r.coefficients)
    for (int i = 1; i < order; ++i) c *= 2;
  Balls once;
  for (const Rational& c : r.coefficients) once.push_back(c.enclosure());
  DifferenceNorm best{.order = order, .steps = 1, .norm = residue_norm(once, 2)};
  Balls product = once;
  for (int steps = 2; steps <= most_steps && best.norm.upper() >= 1; ++steps) {
    product = times_spread(product, once, size_t{1} << (steps - 1));
    const Ball norm = residue_norm(product, size_t{1} << steps);
    if (norm.upper() < best.norm.upper()) best = {order, steps, norm};
  }
  return best;
}

CurveRegularity curve_regularity(const Symbol& symbol, const JointSpectralRadiusOptions& options) {
  CurveRegularity r;
  r.mask = trimmed(symbol);
  if (r.mask.coefficients.empty()) throw AnalysisError("a mask of zeros has no limit");
  const Symbol& a = r.mask;
  r.sum_rules = smoothing_factors(a);
  r.independent = has_independent_shifts(a);
  r.verdicts.push_back(affine_invariance(a));
  for (const int which : {0, 1}) {
    int count = 0;
    for (int j = a.first; j <= a.last(); ++j) count += (j % 2 != 0) == (which == 1) && !a.at(j).is_zero();
    const bool dual = !a.shift.is_zero();
    r.costs.push_back({which == 0 ? (dual ? "before" : "point") : (dual ? "after" : "edge"), count});
  }
  r.interpolates = is_interpolatory(a);
  r.positive = holds_for_all(a.coefficients, [](const Rational& c) { return c >= Rational(0); }) == true;
  r.support[0] = Rational(a.first) - a.shift;
  r.support[1] = Rational(a.last()) - a.shift;
  if (r.verdicts[0].answer != Verdict::Answer::proved) {
    r.positive = false;  // limits, if there are any, leave the hull of the points
    r.sum_rules = 0;
    r.smoothness.possible = -1;
    r.verdicts.push_back(
        {.property = "convergence",
         .says = "the polygons converge to continuous curves, not all of them a point",
         .answer = Verdict::Answer::disproved,
         .theorem = "Cavaretta, Dahmen, Micchelli 1991, proposition 2.1: the masks of schemes that converge sum to 1",
         .hypotheses = r.verdicts[0].hypotheses,
         .because = r.verdicts[0].because});
    return r;
  }
  r.degrees = degrees_of(a, r.sum_rules);
  r.degrees.at_least = !r.independent && !r.interpolates;
  std::vector<DifferenceNorm> norms;
  for (int order = 1; order <= r.sum_rules; ++order) norms.push_back(difference_norm(a, order));
  r.smoothness = smoothness(curve_transitions(a, r.sum_rules), norms, r.sum_rules, options);
  r.verdicts.insert(r.verdicts.end(), r.smoothness.verdicts.begin(), r.smoothness.verdicts.end());
  return r;
}

std::optional<bool> keeps_points(const CurveScheme<double>& scheme) {
  if (scheme.masks.dual()) return false;
  constexpr int levels = 12;
  ForAll keeps, moves;
  for (int level = 0; level < levels; ++level) {
    const Stencil<double> mask = scheme.masks.child(0)(CurveSite<double>(level, scheme.masks.unknowns()));
    const bool stays = mask.terms().size() == 1 && mask.terms()[0].first == 0 && mask.terms()[0].second == 1;
    keeps.look(stays), moves.look(!stays);
  }
  if (moves.holds() == true) return false;
  return keeps.holds() == true ? std::optional(true) : std::nullopt;
}

std::optional<CurveRegularity> curve_regularity(const std::string& name, const SchemeOptions& options) {
  const std::optional<CurveScheme<double>> scheme = find_curve_scheme<double>(name, options);
  if (!scheme || scheme->masks.unknowns() > 1) return std::nullopt;
  const bool is_stationary = terms_at(*scheme, 0) == terms_at(*scheme, 1);
  if (is_stationary) return curve_regularity(symbol(*find_curve_scheme<Rational>(name, options)));
  CurveRegularity r = curve_regularity(settled_symbol(*scheme));
  const auto weaken = [](std::vector<Verdict>& verdicts) {
    for (Verdict& v : verdicts) {
      v.answer = v.answer == Verdict::Answer::proved      ? Verdict::Answer::evidence_for
                 : v.answer == Verdict::Answer::disproved ? Verdict::Answer::evidence_against
                                                          : v.answer;
      v.hypotheses.push_back(
          {"the masks of the levels tend to these fast enough", std::nullopt, Hypothesis::By::floating});
      v.because += "; of the masks that those of the levels tend to";
    }
  };
  weaken(r.verdicts);
  weaken(r.smoothness.verdicts);
  r.interpolates = r.interpolates && keeps_points(*scheme) == true;
  r.smoothness.notes.push_back("the masks depend on the level; those that they tend to were analysed");
  return r;
}

BasisSamples basis_samples(const Symbol& symbol, int levels) {
  const Symbol a = trimmed(symbol);
  BasisSamples samples;
  const std::vector<double> c = doubles(a, 1), c2 = doubles(a, 2);
  samples.value = at_integers(c, false);
  if (samples.value.empty()) return samples;
  samples.value = refined(samples.value, c, levels);
  samples.derivative = at_integers(c2, true);
  if (!samples.derivative.empty()) samples.derivative = refined(samples.derivative, c2, levels);
  const double start = (Rational(a.first) - a.shift).value(), step = std::ldexp(1, -levels);
  for (size_t i = 0; i < samples.value.size(); ++i) samples.x.push_back(start + step * static_cast<double>(i));
  return samples;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/surface_regularity.h"

#include <algorithm>
#include <cmath>

#include "sublimit/certificates/regularity/difference_space.h"
#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit {
namespace {

Offset residue(const Offset& key, int dilation) {
  const auto of = [&](int k) { return (k % dilation + dilation) % dilation; };
  return {of(key[0]), of(key[1])};
}

std::vector<Offset> residues(int dilation) {
  std::vector<Offset> all;
  for (int x = 0; x < dilation; ++x)
    for (int y = 0; y < dilation; ++y) all.push_back({x, y});
  return all;
}

Rational power(int base, int exponent) {
  Rational result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

/// Sums over a residue of weight x^i y^j, (x, y) doubled offsets.
Rational moment(const RegularMask<Rational>& mask, const Offset& r, int i, int j) {
  Rational sum = 0;
  for (const auto& [key, weight] : mask.weights)
    if (residue(key, mask.dilation) == r)
      sum += weight * power(mask.doubled(key)[0], i) * power(mask.doubled(key)[1], j);
  return sum;
}

bool sum_to_one(const RegularMask<Rational>& mask) {
  for (const Offset& r : residues(mask.dilation))
    if (moment(mask, r, 0, 0) != 1) return false;
  return true;
}

/// Polynomials of what degree are generated (moments do not depend on the residue) and reproduced (they vanish).
void find_degrees(SurfaceRegularity& s) {
  constexpr int most = 20;
  bool reproduces = true;
  for (int degree = 0; degree < most; ++degree) {
    for (int i = 0; i <= degree; ++i) {
      const Rational first = moment(s.mask, {0, 0}, i, degree - i);
      for (const Offset& r : residues(s.mask.dilation))
        if (moment(s.mask, r, i, degree - i) != first) return;
      if (degree > 0 && !first.is_zero()) reproduces = false;
    }
    s.sum_rules = degree + 1;
    s.degrees.generates = degree;
    if (reproduces) s.degrees.reproduces = degree;
  }
  s.degrees.at_least = true;
}

std::string kind_of(const RegularMask<Rational>& mask, const Offset& r) {
  if (mask.dual) return "corner";
  if (r == Offset{0, 0}) return "vertex";
  if (mask.dilation == 3) return "other";
  return !mask.triangular && r == Offset{1, 1} ? "face" : "edge";
}

std::vector<std::array<Rational, 2>> hull(const RegularMask<Rational>& mask) {
  std::vector<LatticePoint> points;
  for (const auto& [key, weight] : mask.weights) points.push_back(mask.doubled(key));  // in order of x, then y
  const auto turn = [](LatticePoint a, LatticePoint b, LatticePoint c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  std::vector<LatticePoint> chain;
  for (const int pass : {0, 1}) {
    const size_t start = chain.size();
    for (const LatticePoint p : points) {
      while (chain.size() >= start + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  std::vector<std::array<Rational, 2>> outline;  // offsets over dilation^1, dilation^2, ... add up
  for (const LatticePoint p : chain)
    outline.push_back({Rational(p[0]) / (2 * (mask.dilation - 1)), Rational(p[1]) / (2 * (mask.dilation - 1))});
  return outline;
}

void use_tensor(SurfaceRegularity& s, const std::array<Symbol, 2>& factors, const JointSpectralRadiusOptions& options) {
  CurveRegularity curves[2] = {curve_regularity(factors[0], options), {}};
  const bool alike = factors[0].first == factors[1].first && factors[0].coefficients == factors[1].coefficients;
  curves[1] = alike ? curves[0] : curve_regularity(factors[1], options);
  const auto rank = [](const CurveRegularity& c) {
    return std::pair(c.smoothness.continuity, c.smoothness.exponent_low);
  };
  const int which = rank(curves[1]) < rank(curves[0]) ? 1 : 0;
  s.smoothness = curves[which].smoothness;
  s.degrees.at_least |= curves[0].degrees.at_least || curves[1].degrees.at_least;
  for (Verdict& v : s.smoothness.verdicts) {
    v.hypotheses.insert(v.hypotheses.begin(),
                        {"the mask is the product of two curve masks", true, Hypothesis::By::exact,
                         std::to_string(factors[0].coefficients.size()) + " by " +
                             std::to_string(factors[1].coefficients.size()) + " weights"});
    v.because = "a tensor product: " + v.because;
  }
  s.smoothness.notes.push_back("a tensor product of curve schemes, as smooth as these");
}

void use_differences(SurfaceRegularity& s, const JointSpectralRadiusOptions& options) {
  const int order = std::min(s.sum_rules, 4);
  const DifferenceTransitions points = difference_transitions(s.mask, order);
  DifferenceTransitions limits = points;
  limits.stable = limits.necessary = s.interpolates;
  limits.necessary_because = "old points stay, so differences of points are those of the limit";
  if (!s.interpolates) {
    const Functional values = limit_functional(s.mask);
    constexpr int most = 8;
    s.degrees.at_least = true;
    if (!values.empty()) {
      try {
        while (s.degrees.generates < most && generates(s.mask, values, s.degrees.generates + 1)) ++s.degrees.generates;
        s.degrees.at_least = s.degrees.generates >= most;
      } catch (const AnalysisError&) {  // too many dimensions: what was found is a lower bound
      }
      limits = difference_transitions(s.mask, std::min(s.degrees.generates + 1, 4), values);
      limits.stable = false;
      limits.necessary = true;
      limits.necessary_because = "the differences are those of the limit at the points of a level";
    }
  }
  s.smoothness = smoothness(points, {}, s.sum_rules, options, &limits);
}

}  // namespace

bool keeps_vertices(const RegularMask<Rational>& mask) {
  if (mask.dual) return false;
  const auto moves = [&](const auto& term) {
    return residue(term.first, mask.dilation) == Offset{0, 0} && term.first != Offset{0, 0};
  };
  const auto centre = mask.weights.find({0, 0});
  return centre != mask.weights.end() && centre->second == 1 && std::ranges::none_of(mask.weights, moves);
}

std::optional<std::array<Symbol, 2>> tensor_factors(const RegularMask<Rational>& mask) {
  if (mask.dilation != 2) return std::nullopt;
  std::map<int, Rational> sums[2];
  for (const auto& [key, weight] : mask.weights)
    for (const int k : {0, 1}) sums[k][key[k]] += weight / 2;
  for (const auto& [x, a] : sums[0])
    for (const auto& [y, b] : sums[1]) {
      const auto at = mask.weights.find({x, y});
      if ((at == mask.weights.end() ? Rational(0) : at->second) != a * b) return std::nullopt;
    }
  std::array<Symbol, 2> factors;
  for (const int k : {0, 1}) {
    Symbol& f = factors[k];
    f.shift = mask.dual ? Number<Rational>::ratio(1, 2) : Rational(0);
    f.first = sums[k].begin()->first;
    f.coefficients.resize(sums[k].rbegin()->first - f.first + 1);
    for (const auto& [power, weight] : sums[k]) f.coefficients[power - f.first] = weight;
    f = trimmed(std::move(f));
  }
  return factors;
}

SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask, const JointSpectralRadiusOptions& options) {
  SurfaceRegularity s;
  s.mask = mask;
  s.outline = hull(mask);
  s.positive = holds_for_all(mask.weights, [](const auto& term) { return term.second > Rational(0); }) == true;
  for (const Offset& r : residues(mask.dilation)) {
    int count = 0;
    for (const auto& [key, weight] : mask.weights) count += residue(key, mask.dilation) == r;
    s.costs.push_back({kind_of(mask, r), count});
  }
  s.interpolates = keeps_vertices(mask);
  const bool affine = sum_to_one(mask);
  Verdict invariance{.property = "affine-invariance",
                     .says = "new points move with the old ones under affine maps",
                     .theorem = "affine combinations: the weights of each new point sum to 1",
                     .hypotheses = {{"the weights of every new point sum to 1", affine, Hypothesis::By::exact}}};
  invariance.answer = answer_of(invariance.hypotheses, true);
  invariance.because = affine ? "all masks sum to 1" : "a mask does not sum to 1";
  s.verdicts.push_back(std::move(invariance));
  if (!affine) {
    s.positive = false;
    s.smoothness.possible = -1;
    s.verdicts.push_back(
        {.property = "convergence",
         .says = "the levels converge to continuous limits, not all of them a point",
         .answer = Verdict::Answer::disproved,
         .theorem = "Cavaretta, Dahmen, Micchelli 1991, proposition 2.1: the masks of schemes that converge sum to 1",
         .hypotheses = s.verdicts[0].hypotheses,
         .because = s.verdicts[0].because});
    return s;
  }
  find_degrees(s);
  if (const auto factors = tensor_factors(mask)) {
    s.tensor = true;
    use_tensor(s, *factors, options);
  } else {
    try {
      use_differences(s, options);
    } catch (const AnalysisError& error) {  // too many dimensions
      s.smoothness.possible = s.sum_rules;
      s.smoothness.notes.push_back(error.what());
      s.smoothness.verdicts.push_back({.property = "regular-smoothness",
                                       .says = "C^0",
                                       .answer = Verdict::Answer::unknown,
                                       .because = error.what()});
    }
  }
  s.verdicts.insert(s.verdicts.end(), s.smoothness.verdicts.begin(), s.smoothness.verdicts.end());
  return s;
}

SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask) {
  JointSpectralRadiusOptions options;  // four or nine matrices of 20 to 40 rows: a second or two
  options.longest = 3;
  options.most_products = 300;
  options.most_vertices = 250;
  options.least_slack = 0.01;
  return surface_regularity(mask, options);
}

SurfaceSamples basis_samples(const RegularMask<Rational>& mask, int levels) {
  std::map<Offset, double> points{{{0, 0}, 1.0}};
  int scale = 1;
  for (int k = 0; k < levels; ++k) {
    std::map<Offset, double> finer;
    for (const auto& [place, height] : points)
      for (const auto& [key, weight] : mask.weights)
        finer[{mask.dilation * place[0] + key[0], mask.dilation * place[1] + key[1]}] += height * weight.value();
    points = std::move(finer);
    scale *= mask.dilation;
  }
  Offset low{0, 0}, high{0, 0};
  for (const auto& [place, height] : points)
    for (const int k : {0, 1}) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
    }
  SurfaceSamples samples;
  // A point of index i lies at i + 1/2 where the mask is dual, and so does the one of height 1.
  const double shift = mask.dual ? 0.5 : 0;
  for (int i = low[0]; i <= high[0]; ++i) samples.x.push_back((i + shift) / scale - shift);
  for (int j = low[1]; j <= high[1]; ++j) samples.y.push_back((j + shift) / scale - shift);
  samples.values.assign(samples.y.size(), std::vector<double>(samples.x.size(), 0.0));
  for (const auto& [place, height] : points) samples.values[place[1] - low[1]][place[0] - low[0]] = height;
  return samples;
}

}  // namespace sublimit

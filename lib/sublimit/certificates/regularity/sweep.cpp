// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/sweep.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/rational_schemes.h"
#include "sublimit/certificates/regularity/surface_regularity.h"
#include "sublimit/certificates/regularity/typed_mask.h"

namespace sublimit {
namespace {

constexpr size_t most_values = 2001;

/// Masks are affine in these tensions: a mask of any value from those of 0 and 1.
bool is_affine(const std::string& scheme, const std::string& option) {
  return option == "tension" && (scheme == "four-point" || scheme == "butterfly");
}

Rational blend(const Rational& zero, const Rational& one, const Rational& t) { return zero + t * (one - zero); }

Symbol blend(const Symbol& zero, const Symbol& one, const Rational& t) {
  Symbol a;
  a.shift = one.shift;
  a.first = std::min(zero.first, one.first);
  for (int j = a.first; j <= std::max(zero.last(), one.last()); ++j)
    a.coefficients.push_back(blend(zero.at(j), one.at(j), t));
  return trimmed(std::move(a));
}

RegularMask<Rational> blend(const RegularMask<Rational>& zero, const RegularMask<Rational>& one, const Rational& t) {
  RegularMask<Rational> mask = one;
  for (const auto& [key, weight] : zero.weights) mask.weights.emplace(key, 0);
  for (auto at = mask.weights.begin(); at != mask.weights.end();) {
    const auto old = zero.weights.find(at->first);
    at->second = blend(old == zero.weights.end() ? Rational(0) : old->second, at->second, t);
    at = at->second.is_zero() ? mask.weights.erase(at) : std::next(at);
  }
  return mask;
}

/// The tensor product of a curve mask with itself.
RegularMask<Rational> tensor(const Symbol& a) {
  RegularMask<Rational> mask;
  for (int i = a.first; i <= a.last(); ++i)
    for (int j = a.first; j <= a.last(); ++j)
      if (!a.at(i).is_zero() && !a.at(j).is_zero()) mask.weights[{i, j}] = a.at(i) * a.at(j);
  return mask;
}

SchemeOptions with(SchemeOptions options, const std::string& name, const Rational& value) {
  options[name] = to_string(value);
  return options;
}

Smoothness one_value(const std::string& scheme, bool is_curve, const std::string& option, const Rational& value,
                     const SchemeOptions& others) {
  JointSpectralRadiusOptions quick;  // many values: coarser bounds
  quick.longest = 6;
  quick.least_slack = 1e-4;
  JointSpectralRadiusOptions coarse;
  coarse.longest = 3;
  coarse.most_products = 300;
  coarse.most_vertices = 150;
  coarse.least_slack = 0.1;
  if (is_curve) {
    if (is_affine(scheme, option)) {
      const auto at = [&](int v) { return symbol(*find_curve_scheme<Rational>(scheme, with(others, option, v))); };
      return curve_regularity(blend(at(0), at(1), value), quick).smoothness;
    }
    return curve_regularity(scheme, with(others, option, value))->smoothness;
  }
  const auto mask_at = [&](const Rational& v) {
    return regular_mask(*find_scheme<Rational>(scheme, with(others, option, v)));
  };
  if (is_affine(scheme, option)) return surface_regularity(blend(mask_at(0), mask_at(1), value), coarse).smoothness;
  if (scheme == "kobbelt" && option == "tension") {  // the product of four-point masks
    const auto at = [&](int v) {
      return symbol(*find_curve_scheme<Rational>("four-point", {{"tension", std::to_string(v)}}));
    };
    return surface_regularity(tensor(blend(at(0), at(1), value)), quick).smoothness;
  }
  return surface_regularity(mask_at(value), coarse).smoothness;
}

}  // namespace

SweepRange sweep_range(const std::string& text) {
  const auto refuse = [&](const std::string& what) -> void {
    throw InvalidOption("sweep '" + text + "': " + what + "; write it like tension=0:4:0.05 (first, last, step)");
  };
  SweepRange range;
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) refuse("an option and its values, with = between, are needed");
  range.option = text.substr(0, equals);
  std::vector<Rational> numbers;
  std::string word;
  for (const char c : text.substr(equals + 1) + ":") {
    if (c != ':') {
      word += c;
      continue;
    }
    const std::optional<Rational> number = typed_number(word);
    if (!number) refuse("'" + word + "' is not a number");
    numbers.push_back(*number);
    word.clear();
  }
  if (numbers.size() != 3) refuse(std::to_string(numbers.size()) + " numbers instead of 3");
  if (numbers[2] <= Rational(0)) refuse("the step must be positive");
  if (numbers[1] < numbers[0]) refuse("the last value is before the first");
  if ((numbers[1] - numbers[0]) / numbers[2] > Rational(most_values - 1))
    refuse("more than " + std::to_string(most_values) + " values");
  for (Rational v = numbers[0]; v <= numbers[1]; v += numbers[2]) range.values.push_back(v);
  return range;
}

Sweep sweep(const std::string& scheme, const SweepRange& range, const SchemeOptions& others) {
  const std::optional<CurveScheme<double>> curve = find_curve_scheme<double>(scheme, others);
  const std::optional<Scheme<double>> surface = curve ? std::nullopt : find_scheme<double>(scheme, others);
  if (!curve && !surface) throw InvalidOption("there is no curve or surface scheme '" + scheme + "'");
  if (curve && curve->masks.unknowns() > 1)
    throw InvalidOption(scheme + " has derivatives among its unknowns; its smoothness is not analysed");
  const std::vector<OptionInfo>& infos = curve ? curve->options : surface->options;
  const auto info =
      std::find_if(infos.begin(), infos.end(), [&](const OptionInfo& i) { return i.name == range.option; });
  if (info == infos.end()) throw InvalidOption("scheme " + scheme + " has no option '" + range.option + "' to sweep");
  if (!info->range)
    throw InvalidOption("option " + range.option + " of " + scheme + " is no number: it takes " +
                        allowed_values(*info));
  Sweep result{.scheme = scheme, .range = range};
  for (const Rational& value : range.values) {
    SweepPoint point{.value = value};
    try {
      point.smoothness = one_value(scheme, curve.has_value(), range.option, value, others);
    } catch (const Error& error) {
      point.in_range = false;
      point.why = error.what();
    }
    result.points.push_back(std::move(point));
  }
  size_t missing = 0;
  for (size_t i = 0; i < result.points.size(); ++i) {
    const SweepPoint& p = result.points[i];
    if (!p.in_range) {
      ++missing;
      continue;
    }
    const auto word = [](int k) { return k < 0 ? std::string("no continuity") : "C^" + std::to_string(k); };
    const bool first = i == 0 || !result.points[i - 1].in_range;
    if (first || result.points[i - 1].smoothness.continuity != p.smoothness.continuity)
      result.findings.push_back("from " + range.option + " = " + to_string(p.value) +
                                " on: " + word(p.smoothness.continuity) + " is proved");
  }
  if (missing > 0)
    result.findings.push_back(
        std::to_string(missing) + " values are outside what the scheme takes: " +
        std::find_if(result.points.begin(), result.points.end(), [](const SweepPoint& p) { return !p.in_range; })->why);
  return result;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/knot_json.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sublimit/certificates/spectra/knot_spectrum.h"

namespace sublimit::report {
namespace {

Json hypothesis(const std::string& says, const Json& holds, const std::string& by, const std::string& value) {
  return {{"says", says}, {"holds", holds}, {"by", by}, {"value", value}};
}

const char* centres(const Scheme<double>& scheme) { return scheme.is_dual() ? "faces" : "vertices"; }
std::string says(const Scheme<double>& scheme) {
  return std::string("C^1 at extraordinary ") + centres(scheme) + " between unequal intervals";
}

Json levelled_json(const Scheme<double>& scheme, const Json& all_valences) {
  const bool proved = all_valences.is_object() && all_valences.value("verdict", "") == "proved";
  const std::string because =
      std::string("from the third level on the rows around extraordinary ") + centres(scheme) +
      " are those of equal intervals, whatever the intervals are, and regular regions are B-splines: what is found for "
      "equal intervals holds for all";
  return {
      {"rule", "levelling"},
      {"equal_from_level", 3},
      {"verdict",
       {{"property", "c1-unequal-intervals"},
        {"says", says(scheme)},
        {"verdict", proved ? "proved" : "unknown"},
        {"theorem", "Reif 1995, theorem 2.1, for the rows of the third level"},
        {"hypotheses",
         {hypothesis("C^1 at all valences where intervals are equal", proved ? Json(true) : Json(), "enclosure", ""),
          hypothesis(
              std::string("intervals around extraordinary ") + centres(scheme) + " are equal from the third level on",
              true, "exact", "new knots at half of the least interval")}},
        {"because", because},
        {"witness", nullptr}}},
      {"spectra", Json::array()}};
}

Json halved_json(const Scheme<double>& scheme) {
  // Equal ones, one and two that are longer, and two sides with different ones.
  std::vector<std::vector<double>> samples{{1, 1, 1},          {1, 1, 4},         {1, 1, 16},      {1, 4, 1, 4},
                                           {1, 1, 1, 1, 1},    {1, 1, 1, 1, 4},   {1, 4, 1, 4, 1}, {1, 1, 1, 1, 16},
                                           {1, 8, 1, 8, 1, 8}, {1, 1, 1, 8, 8, 8}};
  if (scheme.is_dual()) samples.push_back({1, 2, 4});
  Json spectra = Json::array();
  bool clear = true, complex = false;
  constexpr double rounding = 1e-9;
  for (const std::vector<double>& intervals : samples) {
    const auto values = knot_spectrum(scheme, intervals);
    Json moduli = Json::array();
    for (size_t i = 0; i < 4; ++i) moduli.push_back(std::abs(values[i]));
    for (size_t i = 1; i <= 2; ++i) {
      complex |= std::abs(values[i].imag()) > rounding;
      clear &= std::abs(values[i].imag()) <= rounding && values[i].real() > 0;
    }
    clear &= std::abs(values[3]) < std::abs(values[2]) - rounding && std::abs(values[1]) < 1 - rounding;
    spectra.push_back({{"intervals", intervals}, {"moduli", moduli}});
  }
  return {
      {"rule", "halving"},
      {"equal_from_level", nullptr},
      {"verdict",
       {{"property", "c1-unequal-intervals"},
        {"says", says(scheme)},
        {"verdict", clear     ? "evidence-for"
                    : complex ? "unknown"
                              : "evidence-against"},
        {"theorem", ""},
        {"hypotheses",
         {hypothesis("two real eigenvalues between 1 and all others, for the intervals below", clear, "floating", "")}},
        {"because",
         std::string("intervals stay unequal, and the two eigenvalues ") +
             (complex ? "may be complex, so that surfaces wind around a point"
                      : "differ: Reif's criterion is about equal ones") +
             "; what is found of neighbourhoods is for equal intervals only (levelling=on makes them equal)"},
        {"witness", nullptr}}},
      {"spectra", spectra}};
}

}  // namespace

Json knot_json(const Scheme<double>& scheme, const Json& all_valences) {
  switch (scheme.knots) {
    case NewKnots::levelling:
      return levelled_json(scheme, all_valences);
    case NewKnots::halving:
      return halved_json(scheme);
    default:
      return nullptr;
  }
}

}  // namespace sublimit::report

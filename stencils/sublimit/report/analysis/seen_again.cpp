// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/seen_again.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/regularity/rational_schemes.h"
#include "sublimit/report/analysis/claims_json.h"

namespace sublimit::report {
namespace {

/// "-9/64" or "2".
Rational ratio_in(const Json& text) {
  const std::string all = text.get<std::string>();
  const auto is_whole = [](std::string_view digits) {
    return !digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
  };
  const size_t slash = all.find('/'), start = all.starts_with('-') ? 1 : 0;
  const std::string_view word = all;
  const bool has_slash = slash != std::string::npos;
  const std::string_view above = word.substr(start, has_slash ? slash - start : std::string::npos),
                         below = has_slash ? word.substr(slash + 1) : std::string_view("1");
  if (!is_whole(above) || !is_whole(below) || below.find_first_not_of('0') == std::string_view::npos)
    throw FormatError("'" + all + "' is no ratio");
  fmpq_t value;
  fmpq_init(value);
  fmpq_set_str(value, all.c_str(), 10);
  Rational result(value);
  fmpq_clear(value);
  return result;
}

int whole_in(const Json& number) {
  if (!number.is_number_integer() || std::abs(number.get<long>()) > 200)
    throw FormatError(number.dump() + " is no whole number from -200 to 200");
  return number.get<int>();
}

bool has_halves(const Json& regular) { return regular.at("unit").get<double>() != 1; }

/// The mask of `regular` of a curve.
Symbol symbol_in(const Json& regular) {
  const bool dual = has_halves(regular);
  std::map<int, Rational> weights;
  for (const Json& m : regular.at("mask")) {
    const int at = whole_in(m.at("at").at(0));
    weights[dual ? (at + 1) / 2 : at] = ratio_in(m.at("exact"));
  }
  if (weights.empty()) throw FormatError("the mask of a curve has no weights");
  Symbol a;
  a.first = weights.begin()->first;
  a.coefficients.resize(static_cast<size_t>(weights.rbegin()->first - a.first) + 1);
  for (const auto& [at, weight] : weights) a.coefficients[static_cast<size_t>(at - a.first)] = weight;
  a.shift = dual ? Number<Rational>::ratio(1, 2) : Rational(0);
  return a;
}

/// The mask of `regular` of a surface.
RegularMask<Rational> mask_in(const Json& regular) {
  RegularMask<Rational> mask{.triangular = regular.at("grid") == "triangular",
                             .dual = has_halves(regular),
                             .dilation = whole_in(regular.at("dilation"))};
  if (mask.dilation < 2 || mask.dilation > 3) throw FormatError("the dilation is neither 2 nor 3");
  const LatticePoint zero = mask.doubled({0, 0});
  for (const Json& m : regular.at("mask")) {
    const int scale = mask.dual ? 1 : 2;  // `at` is in halves where points are
    const LatticePoint d = LatticePoint{scale * whole_in(m.at("at").at(0)), scale * whole_in(m.at("at").at(1))} - zero;
    if (d.x2 % 2 != 0 || d.y2 % 2 != 0) throw FormatError("the mask has weights between the points of its grid");
    mask.weights[{d.x2 / 2, d.y2 / 2}] = ratio_in(m.at("exact"));
  }
  if (mask.weights.empty()) throw FormatError("the mask has no weights");
  return mask;
}

/// What a regular part decides, without the numbers that bounds were found with.
Json decisions(const Json& regular) {
  Json verdicts = Json::array();
  for (const Json& v : regular.at("verdicts")) verdicts.push_back({v.at("property"), v.at("says"), v.at("verdict")});
  return {{"continuity", regular.at("smoothness").at("continuity")},
          {"generates", regular.at("degrees").at("generates")},
          {"reproduces", regular.at("degrees").at("reproduces")},
          {"verdicts", std::move(verdicts)}};
}

/// Two pairs of bounds of one number, either null where there is none.
bool can_agree(const Json& a, const Json& b) {
  const auto above = [](const Json& low, const Json& high) {
    return low.is_number() && high.is_number() && low.get<double>() > high.get<double>();
  };
  return !above(a.at(0), b.at(1)) && !above(b.at(0), a.at(1));
}

void compare_regular(const Json& given, const Json& made, std::vector<std::string>& wrong) {
  const Json says = decisions(given), gives = decisions(made);
  for (const auto& [key, value] : gives.items())
    if (says[key] != value)
      wrong.push_back(fmt::format("{} is {}, and the mask gives {}", key, says[key].dump(), value.dump()));
  if (!can_agree(given.at("smoothness").at("exponent"), made.at("smoothness").at("exponent")))
    wrong.push_back(fmt::format("the exponent is in {}, and the mask gives {}",
                                given.at("smoothness").at("exponent").dump(),
                                made.at("smoothness").at("exponent").dump()));
}

Json weights_of(const Json& regular) {
  Json all = Json::array();
  for (const Json& m : regular.at("mask")) all.push_back({m.at("at"), m.at("exact")});
  return all;
}

SchemeOptions options_in(const Json& scheme) {
  SchemeOptions options;
  for (const auto& [name, value] : scheme.at("options").items()) options[name] = value.get<std::string>();
  return options;
}

/// SCHEME of a curve as its masks give it: those of the registry, of the mask that its name spells, or its own.
Json curve_again(const Json& scheme) {
  const std::string name = scheme.at("name"), typed = "mask ";
  try {
    if (name.starts_with(typed)) return mask_scheme_json(name.substr(typed.size()));
    if (find_curve_scheme<double>(name, options_in(scheme))) return curve_scheme_json(name, options_in(scheme));
  } catch (const InvalidOption& error) {
    throw FormatError(error.what());
  }
  const CurveRegularity own = curve_regularity(symbol_in(scheme.at("regular")));
  return {{"interpolates", own.interpolates}, {"claims", Json::array()}, {"regular", to_json(own)}};
}

Claims claims_in(const Json& rows) {
  Claims claims;
  claims.generates = claims.reproduces = 0;
  for (const Json& row : rows) {
    const Json& claimed = row.at("claimed");
    const std::string value = claimed.is_boolean() ? claimed.get<bool>() ? "yes" : "no" : claimed.dump();
    try {
      set_claim(claims, row.at("claim").get<std::string>() + "=" + value);
    } catch (const InvalidOption& error) {
      throw FormatError(error.what());
    }
  }
  return claims;
}

Json answers_of(const Json& claims) {
  Json all = Json::object();
  for (const Json& row : claims) all[row.at("claim").get<std::string>()] = {row.at("verdict"), row.at("found")};
  return all;
}

void compare_claims(const Json& given, const Json& made, std::vector<std::string>& wrong) {
  const Json says = answers_of(given), gives = answers_of(made);
  for (const auto& [name, value] : says.items())
    if (!gives.contains(name) || gives[name] != value)
      wrong.push_back(fmt::format(
          "the claim {} is said to be {}, found {}, and the masks give {}", name, value[0].dump(), value[1].dump(),
          gives.contains(name) ? fmt::format("{}, found {}", gives[name][0].dump(), gives[name][1].dump())
                               : "nothing"));
}

NeighborhoodKind kind_in(const Json& neighborhood) {
  const std::string word = neighborhood.at("kind");
  const int n = whole_in(neighborhood.at("n"));
  for (const auto kind :
       {NeighborhoodKind::Kind::vertex, NeighborhoodKind::Kind::face, NeighborhoodKind::Kind::border,
        NeighborhoodKind::Kind::crease, NeighborhoodKind::Kind::corner, NeighborhoodKind::Kind::dart}) {
    const NeighborhoodKind own{kind, n};
    if (own.name() != word) continue;
    if (n < 1 || n > greatest_valence) throw FormatError("no neighbourhood has n = " + std::to_string(n));
    return own;
  }
  throw FormatError("there are no neighbourhoods of kind '" + word + "'");
}

std::string type_in_words(const Json& interpolates) {
  return !interpolates.is_boolean() ? "of no known type" : interpolates.get<bool>() ? "interpolating" : "approximating";
}

}  // namespace

std::vector<std::string> regular_differs(const Json& scheme, const ExactScheme* exact, bool analysed) {
  std::vector<std::string> wrong;
  const Json& regular = scheme.at("regular");
  if (scheme.at("kind") == "curve") {
    const bool has_type = scheme.at("interpolates").is_boolean();
    if (regular.is_null() && !find_curve_scheme<double>(scheme.at("name"), options_in(scheme))) {
      if (has_type) wrong.push_back("the type is said, and there is no mask to tell it by");
      return wrong;
    }
    const Json made = curve_again(scheme);
    if (made.at("interpolates") != scheme.at("interpolates"))
      wrong.push_back(fmt::format("it is said to be {}, and its masks are {}", type_in_words(scheme.at("interpolates")),
                                  type_in_words(made.at("interpolates"))));
    compare_claims(scheme.at("claims"), made.at("claims"), wrong);
    if (regular.is_null() != made.at("regular").is_null())
      wrong.push_back("its regular part is missing, or of another scheme");
    else if (!regular.is_null()) {
      if (weights_of(regular) != weights_of(made.at("regular"))) wrong.push_back("its mask is not that of the scheme");
      compare_regular(regular, made.at("regular"), wrong);
    }
    return wrong;
  }
  const std::optional<RegularMask<Rational>> own = exact ? rational_mask(exact->mask) : std::nullopt;
  if (regular.is_null()) {
    if (own) wrong.push_back("its regular part is missing");
    return wrong;
  }
  const RegularMask<Rational> mask = mask_in(regular);
  if (exact && (!own || *own != mask)) wrong.push_back("its mask is not that of the scheme on regular meshes");
  if (analysed) compare_regular(regular, to_json(surface_regularity(mask)), wrong);
  return wrong;
}

Json rows_again(const Json& neighborhood, const ExactScheme& exact) {
  const auto patch = analysed_patch(exact.scheme, kind_in(neighborhood), &exact.mask);
  return patch ? rows_json(*patch) : Json(nullptr);
}

std::vector<std::string> spectrum_differs(const Json& neighborhood, const ExactScheme& exact) {
  using Answer = Verdict::Answer;
  const NeighborhoodKind kind = kind_in(neighborhood);
  std::vector<std::string> wrong;
  for (const Verdict& made : spectral_verdicts(exact.scheme, kind, &exact.mask)) {
    const Json* given = nullptr;
    int count = 0;
    for (const Json& verdict : neighborhood.at("verdicts"))
      if (verdict.at("property") == made.property) given = &verdict, ++count;
    if (count != 1) {
      wrong.push_back(
          fmt::format("there {} on {}", count == 0 ? "is no verdict" : "is more than one verdict", made.property));
      continue;
    }
    const Json& said = given->at("verdict");
    const auto refuse = [&](const char* by, Answer answer, const std::string& because) {
      const Json right = to_string(answer);
      if (said != right)
        wrong.push_back(fmt::format("{} is said to be {}, and {} of the masks says {}: {}", made.property, said.dump(),
                                    by, right.dump(), because));
    };
    // Where the spectrum allows C^1 the characteristic map decides: witnesses show proofs of it, and nothing disproofs.
    const bool by_map = made.property == "c1" && made.answer != Answer::disproved && made.answer != Answer::borderline;
    if (!by_map) {
      refuse("the spectrum", made.answer, made.because);
    } else if (said == to_string(Answer::disproved)) {
      const Verdict again = C1Prover(exact.scheme).certify(kind.n).verdict;
      refuse("the characteristic map", again.answer, again.because);
    }
  }
  return wrong;
}

std::vector<std::string> conclusions_differ(const Json& scheme) {
  std::vector<std::string> wrong;
  const Finding found = interpolation_inside(scheme.at("neighborhoods"));
  const Json type = found.holds ? Json(*found.holds) : Json(nullptr);
  if (scheme.at("interpolates") != type)
    wrong.push_back(fmt::format("it is said to be {}, and its masks are {}: {}",
                                type_in_words(scheme.at("interpolates")), type_in_words(type), found.because));
  const Json& regular = scheme.at("regular");
  if (found.holds == true && regular.is_object() && !keeps_vertices(mask_in(regular)))
    wrong.push_back("it is said to be interpolating, and on regular meshes its mask moves old vertices");
  for (const Json& n : scheme.at("neighborhoods"))
    for (const Json& v : n.at("verdicts")) {
      if (v.at("property") != "affine-invariance") continue;
      const Json rows = n.value("rows", Json()), sums = rows.is_object() ? rows.at("sum_to_one") : Json();
      if (sums.is_boolean() && v.at("verdict") != (sums.get<bool>() ? "proved" : "disproved"))
        wrong.push_back(fmt::format("{} {}: affine-invariance is said to be {}, and its rows {}",
                                    n.at("kind").get<std::string>(), n.at("n").dump(), v.at("verdict").dump(),
                                    sums.get<bool>() ? "sum to 1" : "do not sum to 1"));
    }
  compare_claims(scheme.at("claims"), claims_json(claims_in(scheme.at("claims")), scheme), wrong);
  return wrong;
}

std::vector<std::string> curve_differs(const Json& curve) {
  BezierCurve own;
  own.closed = curve.at("closed").get<bool>();
  for (const Json& piece : curve.at("pieces")) {
    Eigen::MatrixXd points(std::ssize(piece), std::ssize(piece.at(0)));
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      for (Eigen::Index k = 0; k < points.cols(); ++k)
        points(i, k) = piece.at(static_cast<size_t>(i)).at(static_cast<size_t>(k)).get<double>();
    own.pieces.push_back(std::move(points));
  }
  const Json made = curve_json(own, curve.at("tolerance").get<double>());
  std::vector<std::string> wrong;
  const Json &given = curve.at("knots"), &again = made.at("knots");
  if (given.size() != again.size())
    wrong.push_back(fmt::format("{} joints of pieces that have {}", given.size(), again.size()));
  for (size_t i = 0; i < std::min(given.size(), again.size()); ++i)
    for (const char* key : {"at", "c", "g", "verdict"})
      if (given[i].at(key) != again[i].at(key))
        wrong.push_back(fmt::format("joint {}: {} is {}, and the pieces give {}", i, key, given[i].at(key).dump(),
                                    again[i].at(key).dump()));
  return wrong;
}

}  // namespace sublimit::report

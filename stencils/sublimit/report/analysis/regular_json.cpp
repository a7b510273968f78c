// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/report/analysis/regular_json.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/rational_schemes.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/verdict_json.h"

namespace sublimit::report {
namespace {

Json coordinate(const Rational& r) { return stated(r.value()); }

std::string continuity_word(const Smoothness& s) {
  return s.continuity < 0 ? "none proved" : "C^" + std::to_string(s.continuity);
}

Json smoothness_json(const Smoothness& s) {
  Json json;
  json["continuity"] = s.continuity < 0 ? Json(nullptr) : Json(s.continuity);
  json["exponent"] = Json::array({s.continuity < 0 ? Json(nullptr) : stated(s.exponent_low),
                                  s.continuity < 0 || !s.has_upper_bound ? Json(nullptr) : stated(s.exponent_high)});
  std::string notes;
  for (const std::string& note : s.notes) notes += (notes.empty() ? "" : "; ") + note;
  json["notes"] = notes;
  return json;
}

Json norms_json(const Smoothness& s) {
  Json json = Json::array();
  for (const DifferenceNorm& n : s.norms)
    json.push_back({{"order", n.order},
                    {"steps", n.steps},
                    {"norm", stated(n.norm.mid())},
                    {"enclosure", {format_number(n.norm.lower()), format_number(n.norm.upper())}}});
  return json;
}

Json radius_json(const Smoothness& s) {
  if (s.order == 0) return nullptr;
  return {{"order", s.order},
          {"low", stated(s.radius.low)},
          {"high", stated(s.radius.high)},
          {"products", s.radius.product.size()},
          {"vertices", s.radius.vertices}};
}

Json degrees_json(const PolynomialDegrees& d) {
  return {{"generates", d.generates},
          {"reproduces", d.reproduces},
          {"approximation_order", d.approximation_order()},
          {"at_least", d.at_least}};
}

double mean_cost(const std::vector<PointCost>& costs) {
  double sum = 0;
  for (const PointCost& c : costs) sum += c.points;
  return costs.empty() ? 0 : sum / static_cast<double>(costs.size());
}

Json operations_json(const std::vector<PointCost>& costs) {
  std::vector<PointCost> kinds;  // each once
  for (const PointCost& c : costs)
    if (std::none_of(kinds.begin(), kinds.end(),
                     [&](const PointCost& k) { return k.kind == c.kind && k.points == c.points; }))
      kinds.push_back(c);
  Json json;
  json["per_new_point"] = stated(mean_cost(costs));
  json["by_kind"] = Json::array();
  for (const PointCost& c : kinds) json["by_kind"].push_back({{"kind", c.kind}, {"points", c.points}});
  return json;
}

/// The five criteria that textbooks compare schemes by.
Json criteria_json(const std::vector<PointCost>& costs, size_t distinct_weights, const std::string& support,
                   const Smoothness& s, bool interpolates) {
  int most = 0;
  for (const PointCost& c : costs) most = std::max(most, c.points);
  return {{"efficiency", format_number(std::round(mean_cost(costs) * 100) / 100) + " weights per new point"},
          {"support", support},
          {"locality",
           "a new point depends on " + std::to_string(most) + (most == 1 ? " old point" : " old points") + " at most"},
          {"simplicity",
           std::to_string(distinct_weights) + " different weights" + (interpolates ? ", old points stay" : "")},
          {"continuity", continuity_word(s)}};
}

Json verdicts_json(const std::vector<Verdict>& verdicts) {
  Json json = Json::array();
  for (const Verdict& v : verdicts) json.push_back(to_json(v));
  return json;
}

template <class Weights>
size_t distinct(const Weights& weights) {
  std::vector<Rational> seen;
  for (const Rational& w : weights)
    if (!w.is_zero() && std::find(seen.begin(), seen.end(), w) == seen.end()) seen.push_back(w);
  return seen.size();
}

std::string support_text(const SurfaceRegularity& r) {
  Rational width[2] = {0, 0};
  for (const int k : {0, 1}) {
    const auto less = [&](const auto& a, const auto& b) { return a[k] < b[k]; };
    const auto [low, high] = std::minmax_element(r.outline.begin(), r.outline.end(), less);
    width[k] = (*high)[k] - (*low)[k];
  }
  return "within " + to_string(width[0]) + " by " + to_string(width[1]) + " edges, " +
         std::to_string(r.outline.size()) + " corners";
}

/// A claim of a scheme against what was found.
Json claim_json(const std::string& claim, const Json& claimed, const Json& found, Verdict::Answer answer,
                const std::string& because) {
  return {
      {"claim", claim}, {"claimed", claimed}, {"found", found}, {"verdict", to_string(answer)}, {"because", because}};
}

}  // namespace

Json to_json(const CurveRegularity& r) {
  Json json;
  json["dilation"] = 2;
  json["mask"] = Json::array();
  const bool dual = !r.mask.shift.is_zero();
  for (int k = r.mask.first; k <= r.mask.last(); ++k)
    if (!r.mask.at(k).is_zero())
      json["mask"].push_back({{"at", Json::array({dual ? 2 * k - 1 : k})},
                              {"weight", coordinate(r.mask.at(k))},
                              {"exact", to_string(r.mask.at(k))}});
  json["unit"] = dual ? Json(0.5) : Json(1);
  json["grid"] = "line";
  const std::string support = "[" + to_string(r.support[0]) + ", " + to_string(r.support[1]) + "] around its point";
  json["support"] = {
      {"text", support},
      {"outline", Json::array({Json::array({coordinate(r.support[0])}), Json::array({coordinate(r.support[1])})})}};
  json["smoothness"] = smoothness_json(r.smoothness);
  json["norms"] = norms_json(r.smoothness);
  json["joint_spectral_radius"] = radius_json(r.smoothness);
  json["degrees"] = degrees_json(r.degrees);
  json["operations"] = operations_json(r.costs);
  json["basis"] = nullptr;
  if (r.smoothness.continuity >= 0) {
    const BasisSamples samples = basis_samples(r.mask);
    Json basis{{"x", Json::array()}, {"y", Json::array({0})}, {"values", Json::array({Json::array()})}};
    for (const double x : samples.x) basis["x"].push_back(drawn(x));
    for (const double v : samples.value) basis["values"][0].push_back(drawn(v));
    if (r.smoothness.continuity >= 1 && !samples.derivative.empty()) {
      basis["derivative"] = Json::array();
      for (const double v : samples.derivative) basis["derivative"].push_back(drawn(v));
    }
    json["basis"] = std::move(basis);
  }
  json["criteria"] = criteria_json(r.costs, distinct(r.mask.coefficients), support, r.smoothness, r.interpolates);
  json["verdicts"] = verdicts_json(r.verdicts);
  return json;
}

Json to_json(const SurfaceRegularity& r) {
  Json json;
  json["dilation"] = r.mask.dilation;
  json["mask"] = Json::array();
  std::vector<Rational> weights;
  const bool halves = r.mask.dual && r.mask.dilation % 2 == 0;
  for (const auto& [key, weight] : r.mask.weights) {
    const LatticePoint at = r.mask.doubled(key);
    json["mask"].push_back({{"at", halves ? Json{at[0], at[1]} : Json{at[0] / 2, at[1] / 2}},
                            {"weight", coordinate(weight)},
                            {"exact", to_string(weight)}});
    weights.push_back(weight);
  }
  json["unit"] = halves ? Json(0.5) : Json(1);
  json["grid"] = r.mask.triangular ? "triangular" : "square";
  json["support"] = {{"text", support_text(r)}, {"outline", Json::array()}};
  for (const auto& p : r.outline) json["support"]["outline"].push_back({coordinate(p[0]), coordinate(p[1])});
  json["smoothness"] = smoothness_json(r.smoothness);
  json["norms"] = norms_json(r.smoothness);
  json["joint_spectral_radius"] = radius_json(r.smoothness);
  json["degrees"] = degrees_json(r.degrees);
  json["operations"] = operations_json(r.costs);
  json["basis"] = nullptr;
  if (r.smoothness.continuity >= 0) {
    const SurfaceSamples samples = basis_samples(r.mask, r.mask.dilation == 2 ? 3 : 2);
    Json basis{{"x", Json::array()}, {"y", Json::array()}, {"values", Json::array()}};
    for (const double x : samples.x) basis["x"].push_back(drawn(x));
    for (const double y : samples.y) basis["y"].push_back(drawn(y));
    for (const std::vector<double>& row : samples.values) {
      Json heights = Json::array();
      for (const double v : row) heights.push_back(drawn(v, 4));
      basis["values"].push_back(std::move(heights));
    }
    json["basis"] = std::move(basis);
  }
  json["criteria"] = criteria_json(r.costs, distinct(weights), support_text(r), r.smoothness, r.interpolates);
  json["verdicts"] = verdicts_json(r.verdicts);
  return json;
}

Json to_json(const Sweep& sweep) {
  Json json;
  json["option"] = sweep.range.option;
  json["values"] = Json::array();
  Json continuity = Json::array(), low = Json::array(), high = Json::array();
  for (const SweepPoint& p : sweep.points) {
    json["values"].push_back(coordinate(p.value));
    const bool known = p.in_range && p.smoothness.continuity >= 0;
    continuity.push_back(known ? Json(p.smoothness.continuity) : Json(nullptr));
    low.push_back(known ? stated(p.smoothness.exponent_low) : Json(nullptr));
    high.push_back(known && p.smoothness.has_upper_bound ? stated(p.smoothness.exponent_high) : Json(nullptr));
  }
  json["series"] = Json::array({{{"name", "continuity, proved"}, {"values", std::move(continuity)}},
                                {{"name", "exponent, lower bound"}, {"values", std::move(low)}},
                                {{"name", "exponent, upper bound"}, {"values", std::move(high)}}});
  json["findings"] = sweep.findings;
  return json;
}

Json curve_json(const BezierCurve& curve, double tolerance) {
  const std::vector<CurveJoint> joints = curve_joints(curve, tolerance);
  Json json;
  Eigen::Index degree = 0;
  json["degree"] = 0;
  json["closed"] = curve.closed;
  json["tolerance"] = stated(tolerance);
  json["pieces"] = Json::array();
  for (const Eigen::MatrixXd& piece : curve.pieces) {
    degree = std::max(degree, piece.rows() - 1);
    Json points = Json::array();
    for (Eigen::Index i = 0; i < piece.rows(); ++i) {
      Json point = Json::array();
      for (Eigen::Index k = 0; k < piece.cols(); ++k) point.push_back(stated(piece(i, k)));
      points.push_back(std::move(point));
    }
    json["pieces"].push_back(std::move(points));
  }
  json["degree"] = degree;
  json["knots"] = Json::array();
  for (const CurveJoint& j : joints) {
    Json knot;
    knot["at"] = j.piece + 1;
    knot["c"] = j.c < 0 ? Json(nullptr) : Json(j.c);
    knot["g"] = j.g < 0 ? Json(nullptr) : Json(j.g);
    knot["tangent_ratio"] = j.ratios.empty() ? Json(nullptr) : stated(j.ratios[0]);
    knot["ratios"] = Json::array();
    for (const double ratio : j.ratios) knot["ratios"].push_back(stated(ratio));
    knot["verdict"] = j.c < 0             ? std::string("not continuous")
                      : j.same_polynomial ? std::string("no knot")
                                          : "C^" + std::to_string(j.c) + ", G^" + std::to_string(j.g) +
                                                (j.g_is_least ? " at least" : "");
    knot["because"] = j.because;
    json["knots"].push_back(std::move(knot));
  }
  return json;
}

Json regular_json(const std::string& scheme, const SchemeOptions& options) {
  if (find_curve_scheme<double>(scheme, options)) {
    const std::optional<CurveRegularity> r = curve_regularity(scheme, options);
    return r ? to_json(*r) : Json(nullptr);
  }
  const std::optional<Scheme<Rational>> surface = find_scheme<Rational>(scheme, options);
  if (!surface) throw InvalidOption("there is no scheme '" + scheme + "'");
  return to_json(surface_regularity(regular_mask(*surface)));
}

Json regular_json(const Scheme<Algebraic>& scheme) {
  std::optional<RegularMask<Algebraic>> found;
  try {
    found = regular_mask(scheme);
  } catch (const AnalysisError&) {  // the rules on regular meshes are not one mask
    return nullptr;
  }
  const std::optional<RegularMask<Rational>> mask = rational_mask(*found);
  return mask ? to_json(surface_regularity(*mask)) : Json(nullptr);
}

Json curve_scheme_json(const std::string& name, const SchemeOptions& options) {
  const std::optional<CurveScheme<double>> scheme = find_curve_scheme<double>(name, options);
  if (!scheme) throw InvalidOption("there is no curve scheme '" + name + "'");
  const std::optional<CurveRegularity> r = curve_regularity(name, options);
  Json json{{"name", name},   {"kind", "curve"},        {"options", Json::object()}, {"source", scheme->source},
            {"mesh", "line"}, {"split", Json::array()}, {"interpolates", nullptr},   {"claims", Json::array()}};
  if (const std::optional<bool> stays = r ? r->interpolates : keeps_points(*scheme)) json["interpolates"] = *stays;
  for (const auto& [option, value] : options) json["options"][option] = value;
  using Answer = Verdict::Answer;
  if (r) {
    const CurveClaims& c = scheme->claims;
    const bool firm = r->smoothness.notes.empty();  // stationary
    const auto at_least = [&](int claimed, int found, int possible) {
      if (found >= claimed) return firm ? Answer::proved : Answer::evidence_for;
      return possible >= claimed ? Answer::unknown : firm ? Answer::disproved : Answer::evidence_against;
    };
    // Of what is not claimed nothing is said.
    const auto add_if = [&](bool claimed, const char* what, bool found, const char* yes, const char* no) {
      const Answer answer = found ? (firm ? Answer::proved : Answer::evidence_for)
                                  : (firm ? Answer::disproved : Answer::evidence_against);
      if (claimed) json["claims"].push_back(claim_json(what, true, found, answer, found ? yes : no));
    };
    const auto most = [&](int found) { return r->degrees.at_least && found == r->degrees.generates ? 1000 : found; };
    // What the verdicts do not exclude is possible.
    Json verdicts = Json::array();
    for (const Verdict& v : r->verdicts) verdicts.push_back(to_json(v));
    const int possible = disproved_continuity(verdicts).value_or(1000) - 1;
    Json& claims = json["claims"];
    claims.push_back(claim_json("regular", c.regular, r->smoothness.continuity,
                                at_least(c.regular, r->smoothness.continuity, possible),
                                r->verdicts.empty() ? "" : "see the verdicts of the regular part"));
    claims.push_back(claim_json("generates", c.generates, r->degrees.generates,
                                at_least(c.generates, r->degrees.generates, most(r->degrees.generates)),
                                "(1+z)^" + std::to_string(r->sum_rules) + " divides the symbol"));
    claims.push_back(claim_json("reproduces", c.reproduces, r->degrees.reproduces,
                                at_least(c.reproduces, r->degrees.reproduces, most(r->degrees.reproduces)),
                                "moments of the masks"));
    add_if(c.convex_hull, "convex-hull", r->positive, "no weight is negative, and they sum to 1",
           "a weight is negative, or they do not sum to 1");
    add_if(c.interpolates, "interpolates", r->interpolates, "old points stay", "old points move");
  }
  json["regular"] = r ? to_json(*r) : Json(nullptr);
  json["neighborhoods"] = Json::array();
  json["all_valences"] = nullptr;
  json["knot_intervals"] = nullptr;
  return json;
}

Json mask_scheme_json(const std::string& mask) {
  const CurveRegularity r = curve_regularity(typed_mask(mask));
  return {{"name", "mask " + mask},         {"kind", "curve"},         {"options", Json::object()},
          {"source", "typed in"},           {"mesh", "line"},          {"split", Json::array()},
          {"interpolates", r.interpolates}, {"claims", Json::array()}, {"regular", to_json(r)},
          {"neighborhoods", Json::array()}, {"all_valences", nullptr}, {"knot_intervals", nullptr}};
}

}  // namespace sublimit::report

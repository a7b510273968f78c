// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/verdicts.h"

#include <array>
#include <map>

#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

std::string holds(const Json& value) {
  if (!value.is_boolean()) return "<span title=\"not decided\">?</span>";
  return value.get<bool>() ? "✓ holds" : "✗ fails";
}

std::string hypotheses(const Json& verdict) {
  const Json& list = at(verdict, "hypotheses");
  const std::string theorem = string(at(verdict, "theorem"));
  const Json& witness = at(verdict, "witness");
  if (theorem.empty() && list.empty()) return {};
  std::string text = "<details><summary>Theorem and hypotheses</summary>";
  if (!theorem.empty()) text += "<p>" + prose(theorem) + "</p>";
  if (list.is_array() && !list.empty()) {
    Table table{"Hypotheses", {"Hypothesis", "", "by", "value"}, {}, "text"};
    for (const Json& h : list)
      table.rows.push_back({prose(at(h, "says")), holds(at(h, "holds")), literal(at(h, "by")),
                            "<span class=\"code\">" + literal(at(h, "value")) + "</span>"});
    text += html(table);
  }
  if (!witness.is_null()) {
    text += "<p class=\"quiet\">The report carries a witness with which a separate checker sees this again";
    if (const std::string kind = string(at(witness, "kind")); !kind.empty()) text += " (" + escaped(kind) + ")";
    text += ".</p>";
  }
  return text + "</details>";
}

std::string claim_words(const Json& claim) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> known = {
      {{"regular", "Smoothness on regular meshes"},
       {"extraordinary", "Smoothness at extraordinary points"},
       {"generates", "Degree of the polynomials it generates"},
       {"reproduces", "Degree of the polynomials it reproduces"},
       {"convex-hull", "Limit within the convex hull"},
       {"interpolates", "Interpolates the control points"}}};
  const std::string word = string(at(claim, "claim"));
  for (const auto& [name, words] : known)
    if (word == name) return words;
  return escaped(word);
}

void count(std::map<std::string, int>& counts, const Json& list) {
  for (const Json& v : list) ++counts[string(at(v, "verdict"), "unknown")];
}

}  // namespace

std::string verdicts(const Json& list) {
  std::string text;
  for (const Json& v : list) {
    text += "<div class=\"judgement\"><p>" + badge(at(v, "verdict")) + " <b>" + prose(at(v, "says")) + "</b></p>";
    if (!string(at(v, "because")).empty()) text += "<p>" + prose(at(v, "because")) + "</p>";
    text += hypotheses(v) + "</div>\n";
  }
  return text.empty() ? text : "<div class=\"judgements\">\n" + text + "</div>\n";
}

std::string claims(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"What the scheme's file claims, and what the masks give",
              {"Claim", "claimed", "found", "verdict", "because"},
              {},
              "wide text"};
  for (const Json& c : list)
    table.rows.push_back({claim_words(c), literal(at(c, "claimed")), literal(at(c, "found")), badge(at(c, "verdict")),
                          prose(at(c, "because"))});
  return html(table);
}

std::string verdict_counts(const Json& report) {
  std::map<std::string, int> counts;
  for (const Json& scheme : at(report, "schemes")) {
    count(counts, at(at(scheme, "regular"), "verdicts"));
    count(counts, at(scheme, "claims"));
    if (const Json& all = at(scheme, "all_valences"); !all.is_null()) count(counts, Json::array({all}));
    for (const Json& n : at(scheme, "neighborhoods")) count(counts, at(n, "verdicts"));
  }
  if (counts.empty()) return {};
  std::string text = "<ul class=\"counts\">";
  for (const char* word : {"proved", "disproved", "evidence-for", "evidence-against", "borderline", "unknown"})
    if (counts[word] > 0) text += "<li><b>" + std::to_string(counts[word]) + "</b> " + badge(Json(word)) + "</li>";
  return text + "</ul>\n";
}

}  // namespace sublimit::page

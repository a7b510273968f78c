// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/claims_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "sublimit/certificates/spectra/for_all.h"
#include "sublimit/report/analysis/verdict_json.h"

namespace sublimit::report {
namespace {

/// `verdict` of a property in a list of verdicts; "unknown" if it is not there. Where there are several, as of C^1, C^2
/// ... on regular meshes, the strongest one in favour.
std::string answer_in(const Json& verdicts, const std::string& property) {
  std::string answer = "unknown";
  bool found = false;
  for (const Json& v : verdicts) {
    if (v.value("property", "") != property) continue;
    const std::string own = v.value("verdict", "unknown");
    if (!found || own == "proved" || (own == "evidence-for" && answer != "proved")) answer = own;
    found = true;
  }
  return answer;
}

bool is_interior(const Json& neighborhood) {
  const std::string kind = neighborhood.value("kind", "");
  return kind == "vertex" || kind == "face";
}

Json claim(const char* name, Json claimed, Json found, const std::string& verdict, const std::string& because) {
  return {{"claim", name},
          {"claimed", std::move(claimed)},
          {"found", std::move(found)},
          {"verdict", verdict},
          {"because", because}};
}

/// "3, 5-9" of ascending numbers.
std::string ranges(const std::vector<int>& numbers) {
  std::string text;
  for (size_t i = 0; i < numbers.size();) {
    size_t j = i;
    while (j + 1 < numbers.size() && numbers[j + 1] == numbers[j] + 1) ++j;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (j > i) text += (j > i + 1 ? "-" : ", ") + std::to_string(numbers[j]);
    i = j + 1;
  }
  return text;
}

using ValencesByAnswer = std::map<std::string, std::vector<int>>;

/// Interior valences by what was found of a property there.
/// @param left_out  the regular valence, where the property is about others
ValencesByAnswer valences_by_answer(const Json& neighborhoods, const std::string& property, int left_out = 0) {
  ValencesByAnswer by;
  for (const Json& n : neighborhoods)
    if (is_interior(n) && n.value("n", 0) != left_out)
      by[answer_in(n["verdicts"], property)].push_back(n.value("n", 0));
  return by;
}

int regular_valence(const Json& scheme) { return scheme.value("mesh", "") == "triangles" ? 6 : 4; }

/// "vertex 5"
std::string place_of(const Json& neighborhood) {
  return neighborhood.value("kind", "") + " " + std::to_string(neighborhood.value("n", 0));
}

/// What the rows of a neighbourhood show; nothing in reports that do not have it.
std::optional<bool> in_rows(const Json& neighborhood, const char* key) {
  const auto rows = neighborhood.find("rows");
  if (rows == neighborhood.end() || !rows->is_object()) return std::nullopt;
  const auto found = rows->find(key);
  if (found == rows->end() || !found->is_boolean()) return std::nullopt;
  return found->get<bool>();
}

std::string verdict_of(const std::optional<bool>& holds) {
  return holds == true ? "proved" : holds == false ? "disproved" : "unknown";
}

/// The weakest of what was found, and where.
std::pair<std::string, std::string> weakest(const ValencesByAnswer& by) {
  for (const char* answer : {"disproved", "evidence-against", "unknown", "borderline", "evidence-for", "proved"})
    if (const auto at = by.find(answer); at != by.end()) return {answer, ranges(at->second)};
  return {"unknown", "none"};
}

std::string joined(const std::string& a, const std::string& b) { return a + (a.empty() || b.empty() ? "" : "; ") + b; }

std::string in_words(const ValencesByAnswer& by) {
  std::string text;
  for (const auto& [answer, valences] : by) text = joined(text, answer + " at " + ranges(valences));
  return text;
}

/// The answer that a row of the summary shows: the one in favour that holds at most valences, or the most frequent
/// one where none is in favour.
std::string prevalent(const ValencesByAnswer& by) {
  const auto rank = [](const ValencesByAnswer::value_type& found) {
    const auto& [answer, valences] = found;
    return std::tuple(answer == "proved" || answer == "evidence-for", valences.size(), answer == "proved");
  };
  return std::ranges::max_element(by, {}, rank)->first;
}

/// What was found at other valences than those of the answer `shown`.
std::string notes_on(const std::string& property, const ValencesByAnswer& by, const std::string& shown = {}) {
  std::string notes;
  for (const auto& [answer, valences] : by)
    if (answer != shown) notes = joined(notes, fmt::format("{} {} at valence {}", property, answer, ranges(valences)));
  return notes;
}

Json regular_claim(const Claims& claims, const Json& regular) {
  if (!regular.is_object() || !regular.contains("smoothness"))
    return claim("regular", claims.regular, nullptr, "unknown", "the regular limit was not looked at");
  const Json& smooth = regular["smoothness"];
  const Json& exponent = smooth["exponent"];
  const int proved = smooth["continuity"].is_number() ? smooth["continuity"].get<int>() : -1;
  const std::optional<int> beyond = disproved_continuity(regular.value("verdicts", Json::array()));
  std::string because = exponent.is_array() ? "Hoelder exponent in " + exponent.dump() : "no bounds";
  if (beyond) because += fmt::format("; C^{} is disproved", *beyond);
  const std::string answer = claims.regular <= proved              ? "proved"
                             : beyond && *beyond <= claims.regular ? "disproved"
                                                                   : "unknown";
  return claim("regular", claims.regular, proved >= 0 ? Json(proved) : Json(nullptr), answer, because);
}

Json extraordinary_claim(const Claims& claims, const Json& scheme) {
  const Json& neighborhoods = scheme["neighborhoods"];
  const int regular = regular_valence(scheme);
  const auto by = valences_by_answer(neighborhoods, claims.extraordinary >= 1 ? "c1" : "convergence", regular);
  if (by.empty())
    return claim("extraordinary", claims.extraordinary, nullptr, "unknown", "no extraordinary valence was looked at");
  if (claims.extraordinary >= 2) {
    const auto c2 = valences_by_answer(neighborhoods, "c2", regular);
    const bool is_no = c2.contains("disproved"), is_c1 = by.size() == 1 && by.contains("proved");
    const std::string beyond = claims.extraordinary > 2 ? "; nothing is known of C^3 there" : "";
    return claim("extraordinary", claims.extraordinary, is_no && is_c1 ? Json(1) : Json(nullptr),
                 is_no                      ? "disproved"
                 : claims.extraordinary > 2 ? "unknown"
                                            : weakest(c2).first,
                 "C^2: " + in_words(c2) + (is_no ? "" : beyond));
  }
  const std::string answer = weakest(by).first;
  const bool holds = answer == "proved" || answer == "evidence-for";
  return claim("extraordinary", claims.extraordinary, holds ? Json(claims.extraordinary) : Json(nullptr), answer,
               (claims.extraordinary >= 1 ? "C^1: " : "convergence: ") + in_words(by));
}

Json degree_claim(const char* name, int claimed, const Json& regular) {
  const Json* degree = nullptr;
  if (regular.is_object() && regular.contains("degrees") && regular["degrees"][name].is_number())
    degree = &regular["degrees"][name];
  if (!degree) return claim(name, claimed, nullptr, "unknown", "the regular limit was not looked at");
  const int found = degree->get<int>();
  const bool is_least = regular["degrees"].value("at_least", false) && regular["degrees"]["generates"] == found;
  return claim(name, claimed, found,
               found >= claimed ? "proved"
               : is_least       ? "unknown"
                                : "disproved",
               fmt::format("polynomials up to degree {}{}, from the mask", found, is_least ? " at least" : ""));
}

/// Of a neighbourhood that is a piece of a regular mesh: what is known of regular limits is known of it.
void use_regular(Json& neighborhood, const std::string& property, int order, int continuity) {
  if (continuity < order) return;
  for (Json& v : neighborhood["verdicts"]) {
    // What is disproved stays: two verdicts that contradict each other are to be seen.
    if (v["property"] != property || v["verdict"] == "proved" || v["verdict"] == "disproved") continue;
    Verdict verdict{property, v["says"].get<std::string>(), Verdict::Answer::proved};
    verdict.theorem = "a vertex of regular valence among regular ones lies on a regular surface";
    verdict.hypotheses = {{fmt::format("regular surfaces are C^{}", order), true, Hypothesis::By::enclosure,
                           fmt::format("C^{} proved, see the regular part", continuity)}};
    verdict.because = "the neighbourhood is regular";
    v = to_json(verdict);
  }
}

}  // namespace

Finding interpolation_inside(const Json& neighborhoods) {
  ForAll vertices;
  bool has_faces = false;
  for (const Json& n : neighborhoods) {
    const std::string kind = n.value("kind", "");
    has_faces |= kind == "face";
    if (kind == "vertex") vertices.look(in_rows(n, "keeps_centre"), place_of(n));
  }
  if (vertices.holds() == false) return {false, "a vertex moves: " + vertices.where()};
  if (vertices.looked_at() == 0)
    return has_faces ? Finding{false, "no vertex has a child vertex: it becomes a face"}
                     : Finding{std::nullopt, "no vertex inside was looked at"};
  if (!vertices.holds()) return {std::nullopt, "not known of " + vertices.where()};
  return {true,
          fmt::format("each of the {} kinds of vertices looked at inside is its own child", vertices.looked_at())};
}

Finding interpolation(const Json& neighborhoods) {
  const Finding inside = interpolation_inside(neighborhoods);
  if (inside.holds != true) return inside;
  ForAll vertices;
  for (const Json& n : neighborhoods)
    if (n.value("kind", "") != "face") vertices.look(in_rows(n, "keeps_centre"), place_of(n));
  if (vertices.holds() == false) return {false, "a vertex moves: " + vertices.where()};
  if (!vertices.holds()) return {std::nullopt, "not known of " + vertices.where()};
  return {true, fmt::format("each of the {} kinds of vertices looked at is its own child", vertices.looked_at())};
}

Finding convexity(const Json& neighborhoods) {
  ForAll signs, sums;
  for (const Json& n : neighborhoods) {
    signs.look(in_rows(n, "non_negative"), place_of(n));
    sums.look(in_rows(n, "sum_to_one"), place_of(n));
  }
  if (signs.holds() == false) return {false, "a local matrix has a negative weight: " + signs.where()};
  if (sums.holds() == false) return {false, "weights of a local matrix do not sum to 1: " + sums.where()};
  if (signs.looked_at() == 0) return {std::nullopt, "no local matrix was looked at"};
  if (!signs.holds() || !sums.holds()) return {std::nullopt, "not known of " + (signs.holds() ? sums : signs).where()};
  return {true, fmt::format("none of the {} local matrices looked at has a negative weight, and their rows sum to 1",
                            signs.looked_at())};
}

std::optional<int> disproved_continuity(const Json& verdicts) {
  std::optional<int> least;
  for (const Json& v : verdicts) {
    const std::string says = v.value("says", "");
    if (v.value("property", "") != "regular-smoothness" || v.value("verdict", "") != "disproved" ||
        says.rfind("C^", 0) != 0)
      continue;
    const int k = std::atoi(says.c_str() + 2);
    if (!least || k < *least) least = k;
  }
  return least;
}

void use_regular(Json& scheme) {
  const Json& regular = scheme["regular"];
  if (!regular.is_object() || !regular["smoothness"]["continuity"].is_number()) return;
  if (answer_in(regular["verdicts"], "regular-smoothness") != "proved") return;
  const int continuity = regular["smoothness"]["continuity"], valence = regular_valence(scheme);
  for (Json& n : scheme["neighborhoods"]) {
    if (!is_interior(n) || n["n"] != valence) continue;
    use_regular(n, "c1", 1, continuity);
    use_regular(n, "c2", 2, continuity);
  }
}

Json claims_json(const Claims& claims, const Json& scheme) {
  const Json regular = scheme.value("regular", Json());
  Json all = Json::array();
  all.push_back(regular_claim(claims, regular));
  all.push_back(extraordinary_claim(claims, scheme));
  all.push_back(degree_claim("generates", claims.generates, regular));
  all.push_back(degree_claim("reproduces", claims.reproduces, regular));
  const auto add = [&](const char* name, const Finding& found) {
    all.push_back(
        claim(name, true, found.holds ? Json(*found.holds) : Json(nullptr), verdict_of(found.holds), found.because));
  };
  if (claims.convex_hull) add("convex-hull", convexity(scheme["neighborhoods"]));
  if (claims.interpolates) add("interpolates", interpolation(scheme["neighborhoods"]));
  return all;
}

Json summary_row(const Json& scheme) {
  const Json regular = scheme.value("regular", Json());
  const Json interpolates = scheme.value("interpolates", Json());
  Json row{{"scheme", scheme["name"]},
           {"type", !interpolates.is_boolean() ? Json(nullptr)
                    : interpolates.get<bool>() ? Json("interpolating")
                                               : Json("approximating")},
           {"mesh", scheme["mesh"]},
           {"regular", nullptr},
           {"extraordinary", nullptr},
           {"regular_verdict", "unknown"},
           {"extraordinary_verdict", "unknown"},
           {"valences", ""},
           {"notes", ""}};
  if (regular.is_object() && regular.contains("smoothness") && regular["smoothness"]["continuity"].is_number()) {
    const int k = regular["smoothness"]["continuity"];
    row["regular"] = fmt::format("C^{}", k);
    row["regular_verdict"] =
        answer_in(regular.value("verdicts", Json::array()), k > 0 ? "regular-smoothness" : "convergence");
  }
  const ValencesByAnswer by = valences_by_answer(scheme["neighborhoods"], "c1");
  std::string moves;
  if (const Finding all = interpolation(scheme["neighborhoods"]); interpolates == true && all.holds == false)
    moves = all.because;
  row["notes"] = moves;
  // Of the regular valence alone nothing follows for extraordinary points.
  if (valences_by_answer(scheme["neighborhoods"], "c1", regular_valence(scheme)).empty()) return row;
  const bool is_c1 = by.contains("proved") || by.contains("evidence-for");
  const ValencesByAnswer shown = is_c1 ? by : valences_by_answer(scheme["neighborhoods"], "convergence");
  const std::string answer = prevalent(shown);
  row["extraordinary"] = is_c1 ? "C^1" : "C^0";
  row["extraordinary_verdict"] = answer;
  row["valences"] = ranges(shown.at(answer));
  row["notes"] =
      joined(is_c1 ? notes_on("C^1", by, answer) : joined(notes_on("C^0", shown, answer), notes_on("C^1", by)), moves);
  return row;
}

}  // namespace sublimit::report

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/verify_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <tuple>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/witness/witness.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/registered_rows.h"
#include "sublimit/report/analysis/seen_again.h"

namespace sublimit::report {
namespace {

using Exact = std::optional<ExactScheme>;

constexpr std::array answers = {"proved", "disproved", "evidence-for", "evidence-against", "borderline", "unknown"};
constexpr int deepest = 32;  // levels of nesting; a report has a dozen

/// A witness, and where it stands.
struct Stand {
  const Json* witness;
  std::string scheme, place;  ///< place: "catmull-clark, vertex 5, c1"
  int n = 0;
  bool is_face = false;
  const Exact* exact;
  bool on_regular = false;  ///< of regular valence, and regular surfaces are proved C^1
  size_t order = 0;         ///< of its findings among all
};

/// Proofs of schemes without polynomial pieces bound derivatives by differences; nobody writes witnesses of that.
bool is_by_nets(const Json& verdict) {
  const Json& all = verdict.at("hypotheses");
  return std::any_of(all.begin(), all.end(), [](const Json& h) {
    return h.at("by") == "enclosure" && h.at("says").get<std::string>().find("second differences") != std::string::npos;
  });
}

/// Where the neighbourhood is regular, what is proved of regular surfaces is proved of it.
bool is_by_regular(const Json& verdict) {
  const Json& all = verdict.at("hypotheses");
  return all.size() == 1 && all[0].at("says") == "regular surfaces are C^1";
}

/// By the report's own words; whether they are right is looked at in `regular`.
bool is_proved_regular(const Json& scheme, int n) {
  const Json& regular = scheme.at("regular");
  if (!regular.is_object() || n != (scheme.at("mesh") == "triangles" ? 6 : 4)) return false;
  const Json& continuity = regular.at("smoothness").at("continuity");
  return continuity.is_number() && continuity.get<int>() >= 1;
}

struct Found {
  size_t order;
  std::string what;
};

struct Reader {
  ReportVerification result = {};
  std::vector<Found> findings = {};
  std::vector<Stand> stands = {};
  size_t order = 0;

  void find(const std::string& place, const std::string& what) { findings.push_back({order, place + ": " + what}); }

  void hypotheses(const Json& verdict, const std::string& place) {
    const std::string answer = verdict.at("verdict");
    const Json& all = verdict.at("hypotheses");
    const auto is_false = [](const Json& h) { return h.at("holds") == false && h.at("by") != "floating"; };
    if (answer == "disproved" && std::none_of(all.begin(), all.end(), is_false))
      find(place, "said to be disproved, although no hypothesis is known to fail");
    if (answer != "proved") return;
    if (all.empty()) find(place, "said to be proved, without a hypothesis");
    for (const Json& h : verdict.at("hypotheses")) {
      const std::string says = h.at("says");
      const Json& holds = h.at("holds");
      if (h.at("by") == "floating") find(place, "said to be proved, by floating numbers: '" + says + "'");
      if (!holds.is_boolean() || !holds.get<bool>())
        find(place, "said to be proved, although this does not hold or is not known: '" + says + "'");
    }
  }

  /// @param stand  where a witness may stand; null: nowhere
  void verdict(const Json& verdict, const std::string& owner, const Stand* stand) {
    ++order, ++result.verdicts;
    const std::string property = verdict.at("property"), answer = verdict.at("verdict");
    const std::string place = owner + ", " + property;
    if (std::find(answers.begin(), answers.end(), answer) == answers.end())
      find(place, "'" + answer + "' is no verdict");
    hypotheses(verdict, place);
    const Json& witness = verdict.at("witness");
    if (witness.is_null()) {
      const bool needs_one = property == "c1" && answer == "proved";
      if (needs_one && stand && stand->on_regular && is_by_regular(verdict))
        ++result.decided;
      else if (needs_one && is_by_nets(verdict))
        ++result.by_nets;
      else if (needs_one)
        find(place, "said to be proved, without a witness");
      else
        result.decided += answer == "proved" || answer == "disproved";
      return;
    }
    if (property != "c1" || !stand) return find(place, "there is a witness, and witnesses of this are not known");
    if (answer != "proved") return find(place, "the witness is one of a proof, and the verdict is " + answer);
    Stand here = *stand;
    here.witness = &witness;
    here.place = place;
    here.order = order;
    stands.push_back(here);
  }

  void scheme(const Json& scheme, const Exact& exact) {
    const std::string name = scheme.at("name");
    if (const Json& regular = scheme.at("regular"); !regular.is_null())
      for (const Json& v : regular.at("verdicts")) verdict(v, name + ", regular", nullptr);
    if (const auto all = scheme.find("all_valences"); all != scheme.end() && !all->is_null())
      verdict(*all, name + ", all valences", nullptr);
    if (const auto knots = scheme.find("knot_intervals"); knots != scheme.end() && knots->is_object()) {
      const std::string place = name + ", knot intervals";
      verdict(knots->at("verdict"), place, nullptr);
      const Json all = scheme.value("all_valences", Json());
      if (knots->at("verdict").at("verdict") == "proved" && !(all.is_object() && all.at("verdict") == "proved"))
        find(place, "said to be proved, although C^1 at all valences is not");
    }
    for (const Json& n : scheme.at("neighborhoods")) {
      const std::string kind = n.at("kind");
      Stand stand{nullptr, name, "", n.at("n").get<int>(), kind == "face", &exact};
      stand.on_regular = is_proved_regular(scheme, stand.n);
      const bool closed = kind == "vertex" || kind == "face";
      const std::string place = fmt::format("{}, {} {}", name, kind, stand.n);
      if (closed) {
        const Json& all = n.at("verdicts");
        const auto is_c1 = [](const Json& v) { return v.at("property") == "c1"; };
        const auto count = std::count_if(all.begin(), all.end(), is_c1);
        if (count != 1) find(place, count == 0 ? "there is no verdict on c1" : "there are several verdicts on c1");
      }
      for (const Json& v : n.at("verdicts")) verdict(v, place, closed ? &stand : nullptr);
    }
  }

  void summary(const Json& report) {
    ++order;
    const Json &schemes = report.at("schemes"), &rows = report.at("summary");
    if (rows.size() != schemes.size())
      return find("summary", fmt::format("{} rows for {} schemes", rows.size(), schemes.size()));
    for (size_t i = 0; i < rows.size(); ++i) {
      const Json made = summary_row(schemes[i]);
      for (const char* key : {"scheme", "type", "mesh", "regular", "regular_verdict", "extraordinary",
                              "extraordinary_verdict", "valences", "notes"})
        if (rows[i].at(key) != made.at(key))
          find(fmt::format("summary, {}", made.at("scheme").dump()),
               fmt::format("{} is {}, and the verdicts say {}", key, rows[i].at(key).dump(), made.at(key).dump()));
    }
  }
};

SchemeOptions options_of(const Json& scheme) {
  SchemeOptions options;
  for (const auto& [name, value] : scheme.at("options").items()) options[name] = value.get<std::string>();
  return options;
}

/// What is wrong with a witness where it stands; `with_scheme`: its rows were compared.
std::vector<std::string> problems(const Stand& stand, bool& with_scheme) {
  std::vector<std::string> all;
  try {
    const Json& w = *stand.witness;
    all = check_witness(w.dump());
    if (!all.empty()) return all;
    if (w.at("scheme") != stand.scheme) all.push_back("the witness is one of scheme " + w.at("scheme").dump());
    if (w.at("n") != stand.n || w.at("dual") != stand.is_face)
      all.push_back(fmt::format("the witness is one of a {} with n = {}", w.at("dual") == true ? "face" : "vertex",
                                w.at("n").dump()));
    if (!all.empty() || !*stand.exact) return all;
    const PrecisionScope precision(256);
    with_scheme = true;
    if (const std::string other = differs_from(**stand.exact, w); !other.empty())
      all.push_back("the witness is not one of this scheme: " + other);
  } catch (const nlohmann::json::exception& error) {
    all.push_back(std::string("no witness: ") + error.what());
  } catch (const Error& error) {
    all.push_back(error.what());
  }
  return all;
}

/// Something to look at, on its own: returns what is wrong.
struct Look {
  size_t order = 0;
  std::string place;
  std::function<std::vector<std::string>()> wrong;
};

/// The parts of SCHEME that conclusions are drawn from, with the rows that the masks of the registry give.
Json with_rows(const Json& scheme, const std::vector<Json>& rows) {
  Json light = Json::object();
  for (const char* key : {"name", "kind", "mesh", "interpolates", "claims", "regular"}) light[key] = scheme.at(key);
  light["neighborhoods"] = Json::array();
  for (size_t k = 0; k < scheme.at("neighborhoods").size(); ++k) {
    const Json& n = scheme.at("neighborhoods")[k];
    Json part{{"kind", n.at("kind")}, {"n", n.at("n")}, {"verdicts", n.at("verdicts")}};
    if (!rows.empty())
      part["rows"] = rows[k];
    else if (const auto own = n.find("rows"); own != n.end())
      part["rows"] = *own;
    light["neighborhoods"].push_back(std::move(part));
  }
  return light;
}

/// Rows of a neighbourhood as the report has them (those of earlier builds have none), and verdicts that their spectrum
/// decides, against the masks.
std::vector<std::string> rows_differ(const Json& neighborhood, const ExactScheme& exact, Json& rows) {
  rows = rows_again(neighborhood, exact);
  if (rows.is_null()) return {"the scheme has no such neighbourhood"};
  std::vector<std::string> wrong = spectrum_differs(neighborhood, exact);
  const auto given = neighborhood.find("rows");
  if (given != neighborhood.end() && *given != rows)
    wrong.push_back(fmt::format("its rows are said to be {}, and the masks give {}", given->dump(), rows.dump()));
  return wrong;
}

std::vector<std::string> caught(const std::function<std::vector<std::string>()>& wrong) {
  try {
    return wrong();
  } catch (const nlohmann::json::exception& error) {
    return {std::string("a part is missing, or of another kind: ") + error.what()};
  } catch (const Error& error) {
    return {error.what()};
  }
}

Json parsed(const std::string& text) {
  Json report;
  try {
    report = Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > deepest) throw FormatError("no report: it is nested too deep");
      return true;
    });
  } catch (const nlohmann::json::exception& error) {
    throw FormatError(std::string("not JSON: ") + error.what());
  }
  if (!report.is_object() || report.value("format", Json()) != "sublimit-report")
    throw FormatError("no report of `sublimit analyze --json`: \"format\": \"sublimit-report\" is expected");
  if (report.value("version", Json()) != 1)
    throw FormatError("version " + report.value("version", Json()).dump() +
                      " of the report is not known; this program reads version 1");
  const Json kind = report.value("kind", Json());
  if (kind != "schemes" && kind != "mesh" && kind != "free-form" && kind != "curve" && kind != "sweep")
    throw FormatError("kind " + kind.dump() + " is none of schemes, mesh, free-form, curve and sweep");
  return report;
}

}  // namespace

ReportVerification verify_report(const std::string& text, const ReportVerificationOptions& options) {
  const Json report = parsed(text);
  Reader reader;
  reader.result.kind = report.at("kind");
  std::vector<Exact> exact;
  std::vector<size_t> orders;           // of findings on a scheme as a whole
  std::vector<std::vector<Json>> rows;  // by the masks of the registry
  std::vector<Look> looks, afterwards;  // the latter at what the former have computed
  std::mutex telling;
  try {
    if (reader.result.kind == "curve") looks.push_back({0, "curve", [&] { return curve_differs(report.at("curve")); }});
    if (reader.result.kind == "schemes") {
      const Json& schemes = report.at("schemes");
      if (schemes.empty()) reader.find("schemes", "there are none, so nothing was looked at");
      for (const Json& scheme : schemes)
        exact.push_back(scheme.at("kind") == "surface" ? registered_scheme(scheme.at("name"), options_of(scheme))
                                                       : std::nullopt);
      for (size_t s = 0; s < exact.size(); ++s) {
        orders.push_back(++reader.order);
        reader.scheme(schemes[s], exact[s]);
        rows.emplace_back(exact[s] ? schemes[s].at("neighborhoods").size() : 0);
      }
      reader.summary(report);
      for (size_t s = 0; s < exact.size(); ++s) {
        const Json& scheme = schemes[s];
        const std::string name = scheme.at("name");
        looks.push_back({orders[s], name + ", regular", [&, s] {
                           return regular_differs(schemes[s], exact[s] ? &*exact[s] : nullptr, options.analyse_masks);
                         }});
        for (size_t k = 0; k < rows[s].size(); ++k) {
          const Json& n = scheme.at("neighborhoods")[k];
          looks.push_back(
              {orders[s], fmt::format("{}, {} {}", name, n.at("kind").get<std::string>(), n.at("n").dump()),
               [&, s, k] { return rows_differ(schemes[s].at("neighborhoods")[k], *exact[s], rows[s][k]); }});
        }
        if (scheme.at("kind") == "surface")
          afterwards.push_back(
              {orders[s], name, [&, s] { return conclusions_differ(with_rows(schemes[s], rows[s])); }});
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw FormatError(std::string("a part of the report is missing, or of another kind: ") + error.what());
  }
  const size_t witnesses = reader.stands.size();
  int done = 0;
  parallel_for_blocks(
      static_cast<std::int64_t>(witnesses + looks.size()),
      [&](std::int64_t, std::int64_t i, std::int64_t) {
        const auto at = static_cast<size_t>(i);
        const bool is_witness = at < witnesses;
        bool with_scheme = false;
        const std::vector<std::string> wrong =
            is_witness ? problems(reader.stands[at], with_scheme) : caught(looks[at - witnesses].wrong);
        const std::lock_guard lock(telling);
        const size_t order = is_witness ? reader.stands[at].order : looks[at - witnesses].order;
        const std::string& place = is_witness ? reader.stands[at].place : looks[at - witnesses].place;
        for (const std::string& what : wrong) reader.findings.push_back({order, place + ": " + what});
        reader.result.seen_again += is_witness && wrong.empty();
        reader.result.seen_with_scheme += is_witness && wrong.empty() && with_scheme;
        reader.result.masks_again += !is_witness && wrong.empty();
        if (options.progress) options.progress(++done, static_cast<int>(witnesses + looks.size()));
      },
      1);
  for (const Look& look : afterwards)
    for (const std::string& what : caught(look.wrong))
      reader.findings.push_back({look.order, look.place + ": " + what});
  std::stable_sort(reader.findings.begin(), reader.findings.end(), [](const Found& a, const Found& b) {
    return std::tie(a.order, a.what) < std::tie(b.order, b.what);
  });
  for (Found& finding : reader.findings) reader.result.findings.push_back(std::move(finding.what));
  return std::move(reader.result);
}

}  // namespace sublimit::report

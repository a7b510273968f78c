// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/report/analysis/scheme_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/all_valences.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/knot_json.h"
#include "sublimit/report/analysis/neighborhood.h"
#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/report/analysis/verdict_json.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"

namespace sublimit::report {
namespace {

using Kind = NeighborhoodKind::Kind;

/// Interior valences of which a surface is drawn: below, at and above the regular one, and a high one.
bool has_picture(const Scheme<double>& scheme, const NeighborhoodKind& kind) {
  if (kind.kind != Kind::vertex && kind.kind != Kind::face) return false;
  const int regular = scheme.regular_valence();
  return kind.n == 3 || kind.n == regular || kind.n == regular + 1 || kind.n == 8;
}

Json scheme_json(const ReportedScheme& reported) {
  const Scheme<double>& scheme = reported.scheme;
  Json options = Json::object(), splits = Json::array();
  for (const auto& [name, value] : reported.options) options[name] = value;
  for (const Step<double>& step : scheme.steps) splits.push_back(name(step.split));
  const bool triangles = scheme.face_size() == 3;
  return {{"name", scheme.name},
          {"kind", "surface"},
          {"options", options},
          {"source", scheme.source},
          {"mesh", triangles ? "triangles" : "any"},
          {"split", splits},
          {"interpolates", nullptr}};  // made from what follows
}

/// All valences at once, where it takes no longer than a second or so: higher degrees take ten. Null where nothing is
/// decided.
Json all_valences_json(const SharedAnalysis& shared) {
  if (!shared.prover || !shared.prover->pieces()) return nullptr;
  const RegularPieces& pieces = *shared.prover->pieces();
  if (pieces.degree > (pieces.mask.triangular ? 4 : 3)) return nullptr;
  const Verdict v = all_valences(*shared.prover).verdict;
  return v.answer == Verdict::Answer::proved || v.answer == Verdict::Answer::disproved ? to_json(v) : Json();
}

template <class Job>
void for_all(size_t count, const Job& job) {
  parallel_for_blocks(
      static_cast<std::int64_t>(count),
      [&](std::int64_t, std::int64_t i, std::int64_t) { job(static_cast<size_t>(i)); }, 1);
}

}  // namespace

ReportedScheme reported_scheme(const std::string& name, const SchemeOptions& options) {
  return {scheme_or_throw(name, options), scheme<Algebraic>(name, options), options};
}

Json schemes_report(const std::vector<ReportedScheme>& schemes, const ReportOptions& options) {
  for (const int n : options.valences)
    if (n < least_valence || n > greatest_valence)
      throw InvalidParameter("valence " + std::to_string(n) + " is outside " + std::to_string(least_valence) + " to " +
                             std::to_string(greatest_valence));
  // What is shared comes first, then what is long: regular parts, neighbourhoods, and curves, which are quick.
  std::vector<SharedAnalysis> shared(schemes.size());
  for_all(schemes.size(), [&](size_t s) { shared[s] = shared_analysis(schemes[s]); });
  std::vector<Json> regular(schemes.size()), all(schemes.size()), curves(options.curves.size());
  std::vector<std::vector<NeighborhoodKind>> kinds(schemes.size());
  std::vector<std::vector<Json>> found(schemes.size());
  std::vector<std::function<void()>> jobs;
  for (size_t s = 0; s < schemes.size(); ++s) jobs.push_back([&, s] { regular[s] = regular_json(schemes[s].exact); });
  for (size_t s = 0; s < schemes.size(); ++s) jobs.push_back([&, s] { all[s] = all_valences_json(shared[s]); });
  for (size_t s = 0; s < schemes.size(); ++s) {
    kinds[s] = neighborhoods(schemes[s].scheme, options.valences);
    found[s].resize(kinds[s].size());
    for (size_t k = 0; k < kinds[s].size(); ++k)
      jobs.push_back([&, s, k] {
        found[s][k] = neighborhood(schemes[s], shared[s], kinds[s][k], has_picture(schemes[s].scheme, kinds[s][k]));
      });
  }
  for (size_t c = 0; c < curves.size(); ++c)
    jobs.push_back([&, c] { curves[c] = curve_scheme_json(options.curves[c].name, options.curves[c].options); });
  std::mutex telling;
  int done = 0;
  for_all(jobs.size(), [&](size_t i) {
    jobs[i]();
    const std::lock_guard lock(telling);
    ++done;
    if (options.progress) options.progress(done, static_cast<int>(jobs.size()));
  });
  Json report = report_head("schemes");
  report["schemes"] = Json::array();
  for (size_t s = 0; s < schemes.size(); ++s) {
    Json json = scheme_json(schemes[s]);
    json["claims"] = nullptr;  // its place; it is made from what follows
    json["regular"] = std::move(regular[s]);
    json["neighborhoods"] = Json::array();
    std::map<int, const Json*> borders;
    for (size_t k = 0; k < found[s].size(); ++k)
      if (kinds[s][k].kind == Kind::border) borders[kinds[s][k].n] = &found[s][k];
    for (size_t k = 0; k < found[s].size(); ++k)
      if (Json& n = found[s][k]; n.is_object() && n.contains("same_as")) n = crease_json(*borders.at(kinds[s][k].n));
    for (Json& n : found[s])
      if (!n.is_null()) json["neighborhoods"].push_back(std::move(n));
    json["all_valences"] = std::move(all[s]);
    json["knot_intervals"] = knot_json(schemes[s].scheme, json["all_valences"]);
    use_regular(json);
    if (const auto holds = interpolation_inside(json["neighborhoods"]).holds) json["interpolates"] = *holds;
    json["claims"] = claims_json(schemes[s].scheme.claims, json);
    report["schemes"].push_back(std::move(json));
  }
  for (Json& curve : curves) report["schemes"].push_back(std::move(curve));
  report["summary"] = Json::array();
  for (const Json& scheme : report["schemes"]) report["summary"].push_back(summary_row(scheme));
  return report;
}

void set_claim(Claims& claims, const std::string& text) {
  const size_t at = text.find('=');
  const std::string name = text.substr(0, at), value = at == std::string::npos ? "" : text.substr(at + 1);
  for (const auto& [own, degree] : {std::pair{"regular", &claims.regular},
                                    {"extraordinary", &claims.extraordinary},
                                    {"generates", &claims.generates},
                                    {"reproduces", &claims.reproduces}}) {
    if (name != own) continue;
    int number = -1;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || number < 0 || number > 20)
      throw InvalidOption(fmt::format("claim {}: {} takes a whole number from 0 to 20", text, name));
    *degree = number;
    return;
  }
  for (const auto& [own, flag] :
       {std::pair{"convex-hull", &claims.convex_hull}, {"interpolates", &claims.interpolates}}) {
    if (name != own) continue;
    if (value != "yes" && value != "no") throw InvalidOption(fmt::format("claim {}: {} takes yes or no", text, name));
    *flag = value == "yes";
    return;
  }
  throw InvalidOption(
      fmt::format("claim {}: no such claim; there are regular=N, extraordinary=N, generates=N, reproduces=N, "
                  "convex-hull=yes|no and "
                  "interpolates=yes|no",
                  text));
}

int contradicted_claims(const Json& report) {
  int count = 0;
  for (const Json& scheme : report.value("schemes", Json::array()))
    for (const Json& claim : scheme.value("claims", Json::array())) count += claim.value("verdict", "") == "disproved";
  return count;
}

}  // namespace sublimit::report

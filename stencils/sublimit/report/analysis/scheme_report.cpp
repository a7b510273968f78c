// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/scheme_report.h"

#include <algorithm>
#include <mutex>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/neighborhood.h"
#include "sublimit/schemes.h"

namespace sublimit::report {
namespace {

using Kind = NeighborhoodKind::Kind;

/// Interior valences of which a surface is drawn: below, at and above the regular one, and a high one.
bool has_picture(const Scheme<double>& scheme, const NeighborhoodKind& kind) {
  if (kind.kind != Kind::vertex && kind.kind != Kind::face) return false;
  const int regular = scheme.face_size() == 3 ? 6 : 4;
  return kind.n == 3 || kind.n == regular || kind.n == regular + 1 || kind.n == 8;
}

const char* split_name(Split split) {
  switch (split) {
    case Split::pqq:
      return "pqq";
    case Split::ptq:
      return "ptq";
    case Split::dqq:
      return "dqq";
    case Split::mid_edge:
      return "mid-edge";
    case Split::sqrt3:
      return "sqrt3";
    case Split::dual:
      return "dual";
    case Split::keep:
      return "keep";
    default:
      return "quads";
  }
}

Json scheme_json(const ReportedScheme& reported) {
  const Scheme<double>& scheme = reported.scheme;
  Json options = Json::object(), splits = Json::array();
  for (const auto& [name, value] : reported.options) options[name] = value;
  for (const Step<double>& step : scheme.steps) splits.push_back(split_name(step.split));
  const bool triangles = scheme.face_size() == 3;
  return {{"name", scheme.name},
          {"kind", "surface"},
          {"options", options},
          {"source", scheme.source},
          {"mesh", triangles ? "triangles" : "any"},
          {"split", splits},
          {"interpolates", scheme.claims.interpolates}};
}

}  // namespace

ReportedScheme reported_scheme(const std::string& name, const SchemeOptions& options) {
  std::optional<Scheme<double>> scheme = find_scheme<double>(name, options);
  if (!scheme) throw InvalidOption("unknown scheme '" + name + "'");
  return {std::move(*scheme), *find_scheme<Algebraic>(name, options), options};
}

Json schemes_report(const std::vector<ReportedScheme>& schemes, const ReportOptions& options) {
  for (const int n : options.valences)
    if (n < least_valence || n > greatest_valence)
      throw InvalidParameter("valence " + std::to_string(n) + " is outside " + std::to_string(least_valence) + " to " +
                             std::to_string(greatest_valence));
  struct Job {
    size_t scheme;
    NeighborhoodKind kind;
    Neighborhood found;
  };
  std::vector<Job> jobs;
  for (size_t s = 0; s < schemes.size(); ++s)
    for (const NeighborhoodKind& kind : neighborhoods(schemes[s].scheme, options.valences))
      jobs.push_back({s, kind, {}});
  std::vector<SharedAnalysis> shared(schemes.size());
  parallel_for_blocks(
      static_cast<std::int64_t>(schemes.size()),
      [&](std::int64_t, std::int64_t s, std::int64_t) {
        shared[static_cast<size_t>(s)] = shared_analysis(schemes[static_cast<size_t>(s)]);
      },
      1);
  std::mutex telling;
  int done = 0;
  const auto run = [&](std::int64_t, std::int64_t i, std::int64_t) {
    Job& job = jobs[static_cast<size_t>(i)];
    const ReportedScheme& scheme = schemes[job.scheme];
    job.found = neighborhood(scheme, shared[job.scheme], job.kind, has_picture(scheme.scheme, job.kind));
    const std::lock_guard lock(telling);
    ++done;
    if (options.progress) options.progress(done, static_cast<int>(jobs.size()));
  };
  parallel_for_blocks(static_cast<std::int64_t>(jobs.size()), run, 1);
  Json report = report_head("schemes");
  report["schemes"] = Json::array();
  for (size_t s = 0; s < schemes.size(); ++s) {
    Json json = scheme_json(schemes[s]);
    json["claims"] = nullptr;  // its place; it is made from what follows
    json["regular"] = nullptr;
    json["neighborhoods"] = Json::array();
    WeightFindings weights;
    for (Job& job : jobs) {
      if (job.scheme != s || job.found.json.is_null()) continue;
      weights.has_negative_weights |= job.found.has_negative_weights;
      weights.keeps_vertices &= job.found.keeps_vertices;
      json["neighborhoods"].push_back(std::move(job.found.json));
    }
    json["claims"] = claims_json(schemes[s].scheme.claims, json, weights);
    report["schemes"].push_back(std::move(json));
  }
  report["summary"] = Json::array();
  for (const Json& scheme : report["schemes"]) report["summary"].push_back(summary_row(scheme));
  return report;
}

int contradicted_claims(const Json& report) {
  int count = 0;
  for (const Json& scheme : report.value("schemes", Json::array()))
    for (const Json& claim : scheme.value("claims", Json::array())) count += claim.value("verdict", "") == "disproved";
  return count;
}

}  // namespace sublimit::report

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/fit_jobs/fit_report.h"

#include <cmath>

#include "sublimit/stencils/json/numbers.h"

namespace sublimit {
namespace {

using report::Json;

/// What does not exist is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Numbers>
Json numbers(const Numbers& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json summary_json(const Eigen::VectorXd& errors) {
  const ErrorSummary found = summary(errors);
  return {{"largest", found.largest}, {"rms", found.rms}, {"count", found.count}};
}

Json conditioning_json(const Conditioning& c) {
  return {{"rows", c.rows},
          {"columns", c.columns},
          {"rank", c.rank},
          {"condition", number(c.condition())},
          {"largest_singular_value", number(c.largest)},
          {"smallest_singular_value", number(c.smallest)},
          {"singular_values", numbers(c.singular_values)}};
}

bool is_known(const Conditioning& c) { return c.rows > 0 || c.columns > 0; }

Json attempt_json(const InterpolationAttempt& attempt) {
  return {{"refinements", attempt.refinements},
          {"unknowns", attempt.unknowns},
          {"conditions", attempt.conditions},
          {"position_error", number(attempt.position_error)},
          {"normal_error", number(attempt.normal_error)},
          {"solved", attempt.solved},
          {"undetermined", attempt.undetermined},
          {"contradictory", attempt.contradictory},
          {"why", why_unsolved(attempt)},
          {"conditioning", is_known(attempt.conditioning) ? conditioning_json(attempt.conditioning) : Json(nullptr)}};
}

Json targets_json(const FitReport& report) {
  Json targets;
  if (!report.places.empty()) {
    for (const Place& s : report.places) {
      targets["face"].push_back(s.face);
      targets["u"].push_back(s.u);
      targets["v"].push_back(s.v);
    }
    if (!report.weights.empty()) targets["weight"] = report.weights;
  } else {
    targets["vertex"] = report.vertices;
  }
  for (int c = 0; c < 3; ++c) targets[std::string(1, "xyz"[c])] = numbers(Eigen::VectorXd(report.expected.col(c)));
  targets["position_error"] = numbers(report.position_error);
  if (report.normal_error.size() > 0) targets["normal_error"] = numbers(report.normal_error);
  if (report.curvature_error.size() > 0) targets["curvature_error"] = numbers(report.curvature_error);
  if (!report.carried_by.empty()) targets["carried_by"] = report.carried_by;
  return targets;
}

}  // namespace

std::string fit_report(const FitReport& r) {
  Json json = report::report_head("");
  json["format"] = "sublimit-fit";
  json["kind"] = r.kind;
  json["scheme"] = r.scheme;
  json["options"] = r.options;
  json["mesh"] = {{"file", r.mesh}, {"vertices", r.mesh_vertices}, {"faces", r.mesh_faces}};
  json["output"] = {{"file", r.output},
                    {"vertices", r.output_vertices},
                    {"faces", r.output_faces},
                    {"refinements", r.refinements},
                    {"keeps_vertices", r.keeps_vertices}};
  json["box"] = r.box;
  json["position_error"] = summary_json(r.position_error);
  if (r.normal_error.size() > 0) json["normal_error"] = summary_json(r.normal_error);
  if (r.curvature_error.size() > 0) json["curvature_error"] = summary_json(r.curvature_error);
  json["without_plane"] = r.without_plane;
  json["pinned"] = r.pinned;
  if (!r.attempts.empty()) {
    json["attempts"] = Json::array();
    for (const InterpolationAttempt& attempt : r.attempts) json["attempts"].push_back(attempt_json(attempt));
  }
  if (r.conditioning) json["conditioning"] = conditioning_json(*r.conditioning);
  if (r.solution)
    json["solver"] = {{"method", r.solution->method == FitMethod::iterative ? "iterative" : "direct"},
                      {"iterations", r.solution->iterations},
                      {"converged", r.solution->converged},
                      {"history", numbers(r.solution->history)}};
  for (const FitLevel& level : r.levels)
    json["levels"].push_back({{"vertices", level.vertices},
                              {"triangles", level.triangles},
                              {"longest_edge", level.longest_edge},
                              {"normal_deviation", level.normal_deviation}});
  for (const CloudIteration& i : r.iterations)
    json["iterations"].push_back(
        {{"rms", i.rms}, {"largest", i.largest}, {"energy", i.energy}, {"fairness", i.fairness}});
  json["notes"] = r.notes;
  json["targets"] = targets_json(r);
  json["targets"]["file"] = r.targets;
  return report::report_text(json);
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/report.h"

#include <nlohmann/json.hpp>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"
#include "sublimit/schemes.h"

namespace sublimit {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

Report scheme_report(report::ReportedScheme scheme, const AnalyzeOptions& options) {
  for (const std::string& claim : options.claims) report::set_claim(scheme.scheme.claims, claim);
  return Report(report::report_text(report::schemes_report({std::move(scheme)}, {.valences = options.valences})));
}

}  // namespace

void Report::save_json(const std::filesystem::path& path) const { write(path, json_); }
void Report::save_html(const std::filesystem::path& path) const {
  write(path, report_page(nlohmann::ordered_json::parse(json_)));
}

Report analyze(const AnyScheme& scheme, const AnalyzeOptions& options) {
  const std::optional<Scheme<double>> known = find_scheme(scheme->name, scheme->chosen);
  if (!known || known->source != scheme->source)
    throw InvalidOption(scheme->name +
                        " is a scheme of your own: a report needs its masks in exact numbers too, "
                        "analyze(scheme<double>(), scheme<Algebraic>())");
  return scheme_report(report::reported_scheme(scheme->name, scheme->chosen), options);
}

Report analyze(const Scheme<double>& scheme, const Scheme<Algebraic>& exact, const AnalyzeOptions& options) {
  return scheme_report({scheme, exact, scheme.chosen}, options);
}

Report analyze(const ControlMesh& mesh, const AnyScheme& scheme, const AnalyzeMeshOptions& options) {
  AssetOptions wanted;
  for (const std::string& tolerance : options.tolerance) read_tolerance(tolerance, wanted.tolerance);
  nlohmann::ordered_json all = report::report_head("mesh");
  all["mesh"] = to_json(asset_report(*scheme.for_mesh(mesh), mesh, {}, wanted), options.name);
  return Report(report::report_text(all));
}

}  // namespace sublimit

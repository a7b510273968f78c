// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"
#include "sublimit/scheme/detail/check_scheme.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

std::vector<int> ascending(std::vector<int> valences) {
  std::sort(valences.begin(), valences.end());
  valences.erase(std::unique(valences.begin(), valences.end()), valences.end());
  return valences;
}

/// @throws InvalidParameter  no valences, a scheme that is not complete
Report scheme_report(report::ReportedScheme scheme, const AnalyzeOptions& options) {
  if (options.valences.empty()) throw InvalidParameter("no valences; 3 to 100 are right");
  check_scheme(scheme.scheme);
  check_scheme(scheme.exact);
  for (const std::string& claim : options.claims) report::set_claim(scheme.scheme.claims, claim);
  return Report(
      report::report_text(report::schemes_report({std::move(scheme)}, {.valences = ascending(options.valences)})));
}

}  // namespace

void Report::save_json(const std::filesystem::path& path) const { write(path, json_); }
void Report::save_html(const std::filesystem::path& path) const {
  const nlohmann::ordered_json report = nlohmann::ordered_json::parse(json_, nullptr, /*allow_exceptions=*/false);
  if (report.is_discarded()) throw FormatError("this is no report: its text is no JSON");
  write(path, report_page(report));
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

Report analyze(const Mesh& mesh, const AnyScheme& scheme, const AnalyzeMeshOptions& options) {
  AssetOptions wanted;
  for (const std::string& tolerance : options.tolerance) read_tolerance(tolerance, wanted.tolerance);
  nlohmann::ordered_json all = report::report_head("mesh");
  all["mesh"] = to_json(asset_report(*scheme.for_mesh(mesh), mesh, {}, wanted), options.name);
  return Report(report::report_text(all));
}

}  // namespace sublimit

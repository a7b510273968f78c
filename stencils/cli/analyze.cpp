// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze`: what a scheme's limit is like, and what a mesh's is.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "common.h"
#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/report/analysis/numbers.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"

namespace sublimit::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int negative_verdict = 1;

struct Options {
  Common common;
  std::string valences = "3-12", page, json;
  std::vector<std::string> tolerances;
};

std::vector<report::ReportedScheme> schemes_named(const Common& common) {
  const SchemeOptions options = given_options(common);
  std::vector<report::ReportedScheme> schemes;
  if (common.scheme != "all") {
    (void)scheme_or_throw(common.scheme, options);  // offers the nearest names
    schemes.push_back(report::reported_scheme(common.scheme, options));
    return schemes;
  }
  if (!options.empty()) throw InvalidOption("--option belongs to one scheme; name it with -s");
  for (const Scheme<double>& scheme : all_schemes()) schemes.push_back(report::reported_scheme(scheme.name));
  return schemes;
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_outputs(const Options& options, const Json& report, Progress& progress) {
  if (!options.json.empty()) {
    progress.step("writing " + options.json);
    write_text(options.json, report::report_text(report));
  }
  if (!options.page.empty()) {
    progress.step("drawing " + options.page);
    write_text(options.page, report_page(report));
  }
}

int analyze_schemes(const Options& options) {
  report::ReportOptions wanted;
  wanted.valences = report::parse_valences(options.valences);
  const std::vector<report::ReportedScheme> schemes = schemes_named(options.common);
  Progress progress(options.common.quiet);
  progress.step("analysing");
  wanted.progress = [&](int done, int all) {
    progress.note(fmt::format("analysing: {} of {} neighbourhoods", done, all));
  };
  const Json report = report::schemes_report(schemes, wanted);
  write_outputs(options, report, progress);
  progress.step("");
  return report::contradicted_claims(report) > 0 ? negative_verdict : 0;
}

int analyze_mesh(const Options& options) {
  AssetOptions wanted;
  for (const std::string& tolerance : options.tolerances) read_tolerance(tolerance, wanted.tolerance);
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  progress.step("analysing " + options.common.mesh);
  AssetReport found;
  naming_mesh(options.common, [&] {
    found = asset_report(*loaded.scheme, loaded.mesh, loaded.rules, wanted, [&](int done, int all) {
      progress.note(fmt::format("analysing {}: {} of {}", options.common.mesh, done, all));
    });
  });
  Json report = report::report_head("mesh");
  report["mesh"] = to_json(found, std::filesystem::path(options.common.mesh).filename().string());
  write_outputs(options, report, progress);
  progress.step("");
  return found.seams.within_tolerance ? 0 : negative_verdict;
}

int analyze(const Options& options) {
  limit_threads(options.common);
  if (!options.page.empty()) check_output_path(options.page, {".html", ".htm"});
  if (!options.json.empty()) check_output_path(options.json, {".json"});
  return options.common.mesh.empty() ? analyze_schemes(options) : analyze_mesh(options);
}

}  // namespace

Command add_analyze(CLI::App& app) {
  auto* command = app.add_subcommand("analyze", "How smooth a scheme's limit is, or a mesh's, with proofs");
  auto options = std::make_shared<Options>();
  command->add_option("MESH", options->common.mesh, "A mesh, .obj, .off or .ply: how smooth its own limit is");
  command->add_option("-s,--scheme", options->common.scheme, "A scheme, or all")->required();
  command->add_option("--valence", options->valences, "Valences, as in 3-12 or 3-8,12")->capture_default_str();
  command->add_option("-o,--output", options->page, "The report as a page, .html");
  command->add_option("--json", options->json, "The report as data, .json");
  command->add_option("--tolerance", options->tolerances,
                      "Of a mesh's seams: g0=1e-9, g1=0.1deg, g2=5%; exit 1 beyond");
  command->add_option("--option", options->common.options, "An option of the scheme, name=value");
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit analyze -s catmull-clark -o report.html\n"
      "  sublimit analyze -s all --valence 3-8 -o report.html --json report.json\n"
      "Exit status 1 if a claim of a scheme is contradicted.");
  return [=] { return analyze(*options); };
}

}  // namespace sublimit::cli

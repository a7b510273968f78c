// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze`: what a scheme's limit is like, what a mesh's is, and how free-form curves and surfaces, or those
// of recipes, join.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/exports.h"
#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/page/page.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/json/numbers.h"
#include "support/common.h"
#include "support/free_form.h"
#include "support/memory_limit.h"
#include "support/recipes.h"

namespace sublimit::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int negative_verdict = 1;

struct AnalyzeOptions {
  Common common;
  std::string valences = "3-12", page, json;
  std::vector<std::string> tolerances, claims;
  std::string mask, sweep, exports, picture, memory_limit;
  std::vector<std::string> given;  ///< options on the command line, by their long names
  bool has(const char* option) const { return std::find(given.begin(), given.end(), option) != given.end(); }
};

/// What options belong to; all others are for every job.
constexpr std::pair<const char*, const char*> owners[] = {
    {"--scheme", "schemes, sweeps and meshes"},
    {"--option", "schemes, sweeps and meshes"},
    {"--valence", "schemes"},
    {"--claim", "schemes"},
    {"--export", "schemes"},
    {"--tolerance", "meshes and free-form shapes"},
    {"--mem-limit", "meshes and free-form shapes"},
};

/// An option that would be ignored is a mistake of whoever gave it.
void refuse_others(const AnalyzeOptions& options, const std::string& job) {
  for (const auto& [option, owner] : owners)
    if (options.has(option) && std::string(owner).find(job) == std::string::npos)
      throw InvalidOption(fmt::format("{} is for {}, and this is about {}; leave it out", option, owner, job));
}

struct Named {
  std::vector<report::ReportedScheme> surfaces;
  std::vector<report::ReportedCurve> curves;
};

bool is_curve_scheme(const std::string& name) {
  for (const GeometricCurveScheme& scheme : all_geometric_schemes())
    if (scheme.name == name)
      throw InvalidOption("scheme " + name +
                          " is not linear and has no matrix to analyse; `sublimit schemes --gallery` measures it");
  for (const CurveScheme<double>& scheme : all_curve_schemes())
    if (scheme.name == name) return true;
  return false;
}

Named schemes_named(const AnalyzeOptions& asked) {
  const SchemeOptions options = given_options(asked.common);
  Named named;
  if (asked.common.scheme != "all") {
    if (is_curve_scheme(asked.common.scheme)) {
      named.curves.push_back({asked.common.scheme, options});
      for (const char* option : {"--claim", "--valence", "--export"})
        if (asked.has(option))
          throw InvalidOption(
              fmt::format("{} is for schemes of meshes, and {} refines curves", option, asked.common.scheme));
      return named;
    }
    (void)scheme_or_throw(asked.common.scheme, options);  // offers the nearest names
    named.surfaces.push_back(report::reported_scheme(asked.common.scheme, options));
    for (const std::string& claim : asked.claims) report::set_claim(named.surfaces[0].scheme.claims, claim);
    return named;
  }
  if (!options.empty()) throw InvalidOption("--option belongs to one scheme; name it with -s");
  if (!asked.claims.empty()) throw InvalidOption("--claim belongs to one scheme; name it with -s");
  for (const Scheme<double>& scheme : all_schemes()) named.surfaces.push_back(report::reported_scheme(scheme.name));
  for (const CurveScheme<double>& scheme : all_curve_schemes()) named.curves.push_back({scheme.name, {}});
  return named;
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_outputs(const AnalyzeOptions& options, const Json& report, Progress& progress) {
  if (!options.json.empty()) {
    progress.step("writing " + options.json);
    write_text(options.json, report::report_text(report));
  }
  if (!options.page.empty()) {
    progress.step("drawing " + options.page);
    write_text(options.page, report_page(report));
  }
  if (!options.picture.empty()) write_text(options.picture, report_picture(report));
}

/// What was found, for those who only look at the terminal.
void print_summary(const Json& report) {
  for (const Json& row : report.value("summary", Json::array())) {
    const auto text = [&](const char* key) {
      return row[key].is_string() ? row[key].get<std::string>() : std::string("?");
    };
    fmt::print("{:<22} {:<14} regular {} ({})", text("scheme"), text("type"), text("regular"), text("regular_verdict"));
    if (!text("valences").empty())
      fmt::print(", {} ({}) at valence {}", text("extraordinary"), text("extraordinary_verdict"), text("valences"));
    fmt::print("{}{}\n", text("notes").empty() ? "" : "; ", text("notes"));
  }
  for (const Json& scheme : report.value("schemes", Json::array())) {
    if (const auto knots = scheme.find("knot_intervals"); knots != scheme.end() && knots->is_object())
      fmt::print("{}: unequal knot intervals, {}: {}: {}\n", scheme["name"].get<std::string>(),
                 (*knots)["rule"].get<std::string>(), (*knots)["verdict"]["verdict"].get<std::string>(),
                 (*knots)["verdict"]["because"].get<std::string>());
    for (const Json& claim : scheme.value("claims", Json::array()))
      if (claim.value("verdict", "") == "disproved")
        fmt::print("{}: the claim {} = {} is disproved: {}\n", scheme["name"].get<std::string>(),
                   claim["claim"].get<std::string>(), claim["claimed"].dump(), claim["because"].get<std::string>());
  }
}

int finish(const AnalyzeOptions& options, const Json& report, Progress& progress) {
  write_outputs(options, report, progress);
  progress.step("");
  if (!options.common.quiet) print_summary(report);
  return report::contradicted_claims(report) > 0 ? negative_verdict : 0;
}

int analyze_schemes(const AnalyzeOptions& options) {
  report::ReportOptions wanted;
  wanted.valences = report::parse_valences(options.valences);
  Named named = schemes_named(options);
  wanted.curves = std::move(named.curves);
  if (!options.exports.empty()) {
    make_output_directory(options.exports);
    check_output_path(options.exports + "/matrix.txt", {});
  }
  Progress progress(options.common.quiet);
  progress.step("analysing");
  wanted.progress = [&](int done, int all) { progress.note(fmt::format("analysing: {} of {} parts", done, all)); };
  const Json report = report::schemes_report(named.surfaces, wanted);
  if (!options.exports.empty()) {
    progress.step("exporting to " + options.exports);
    report::write_exports(options.exports, named.surfaces, wanted.valences);
  }
  return finish(options, report, progress);
}

int analyze_mask(const AnalyzeOptions& options) {
  Progress progress(options.common.quiet);
  Json report = report::report_head("schemes");
  report["schemes"] = Json::array({report::mask_scheme_json(options.mask)});
  report["summary"] = Json::array({report::summary_row(report["schemes"][0])});
  const int status = finish(options, report, progress);
  if (!options.common.quiet)
    for (const Json& v : report["schemes"][0]["regular"]["verdicts"])
      fmt::print("  {}: {}: {}\n", v["verdict"].get<std::string>(), v["says"].get<std::string>(),
                 v["because"].get<std::string>());
  return status;
}

int analyze_sweep(const AnalyzeOptions& options) {
  if (options.common.scheme.empty() || options.common.scheme == "all")
    throw InvalidOption("--sweep belongs to one scheme; name it with -s");
  if (!is_curve_scheme(options.common.scheme))
    (void)scheme_or_throw(options.common.scheme);  // offers the nearest names
  const SweepRange range = sweep_range(options.sweep);
  Progress progress(options.common.quiet);
  progress.step(
      fmt::format("analysing {} at {} values of {}", options.common.scheme, range.values.size(), range.option));
  const Sweep found = sweep(options.common.scheme, range, given_options(options.common));
  Json report = report::report_head("sweep");
  report["schemes"] = Json::array({Json{{"name", found.scheme}}});
  report["sweep"] = report::to_json(found);
  write_outputs(options, report, progress);
  progress.step("");
  if (!options.common.quiet)
    for (const std::string& finding : found.findings) fmt::print("{}\n", finding);
  return 0;
}

int analyze_curve(const AnalyzeOptions& options) {
  Progress progress(options.common.quiet);
  const std::string& path = options.common.mesh;
  const std::string text = read_file(path);
  Json report = report::report_head("curve");
  try {
    report["curve"] = report::curve_json(read_bezier_curve(text));
  } catch (const FormatError& error) {
    throw FormatError(path + ": " + error.what());
  }
  write_outputs(options, report, progress);
  progress.step("");
  if (!options.common.quiet)
    for (const Json& knot : report["curve"]["knots"])
      fmt::print("knot {}: {}\n", knot["at"].dump(), knot["because"].get<std::string>());
  return 0;
}

void print_asset(const AssetReport& found, const std::string& file) {
  const auto shown = [](const std::optional<double>& value, const char* unit) {
    return value ? fmt::format("{:.3g}{}", *value, unit) : std::string("none");
  };
  const SeamDeviation& inside = found.seams.inside;
  fmt::print("{}: {} vertices, {} faces under {}\n", file, found.vertices, found.faces, found.scheme);
  fmt::print("  seams: positions {}, normals {}, curvature {} at most\n", shown(inside.g0, ""),
             shown(inside.g1_degrees, " degrees"), shown(inside.g2, ""));
  for (const AssetWarning& warning : found.warnings)
    fmt::print("  {}: {}\n", warning.severity == AssetWarning::Severity::hint ? "hint" : "warning", warning.says);
  for (const SeamExcess& excess : found.seams.beyond)
    fmt::print("  beyond the tolerance: {} {:.3g} at ({:.6g}, {:.6g}, {:.6g})\n", excess.what, excess.value,
               excess.place.x(), excess.place.y(), excess.place.z());
}

int analyze_mesh(const AnalyzeOptions& options) {
  AssetOptions wanted;
  for (const std::string& tolerance : options.tolerances) read_tolerance(tolerance, wanted.tolerance);
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  check_mesh_memory(options.common.mesh, loaded.mesh);
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
  if (!options.common.quiet) print_asset(found, options.common.mesh);
  return found.seams.within_tolerance == false ? negative_verdict : 0;
}

int analyze_shapes(const AnalyzeOptions& options, const Source& source) {
  Progress progress(options.common.quiet);
  const Json report = analyze_free_form(source, options.tolerances, progress);
  write_outputs(options, report, progress);
  progress.step("");
  if (!options.common.quiet) print_free_form_report(report);
  return report["free_form"]["within_tolerance"] == false ? negative_verdict : 0;
}

int analyze(const AnalyzeOptions& options) {
  limit_threads(options.common);
  limit_memory(options.memory_limit);
  if (!options.page.empty()) check_output_path(options.page, all_formats().writers({contents::pages}));
  if (!options.picture.empty()) check_output_path(options.picture, all_formats().writers({contents::pictures}));
  if (!options.json.empty()) check_output_path(options.json, all_formats().writers({contents::reports}));
  if (!options.json.empty() && !options.common.mesh.empty())
    check_not_sidecar("--json", options.json, options.common.mesh);
  const int jobs = !options.common.mesh.empty() + options.has("--mask") + options.has("--sweep");
  if (jobs > 1) throw InvalidOption("a mesh or curve, --mask and --sweep are jobs of their own; give one of them");
  if (options.has("--mask")) return refuse_others(options, "a mask"), analyze_mask(options);
  if (options.has("--sweep")) return refuse_others(options, "sweeps"), analyze_sweep(options);
  const bool is_curve = all_formats().reads(options.common.mesh, contents::rows);
  if (is_curve) return refuse_others(options, "a curve"), analyze_curve(options);
  if (options.common.mesh.empty() && options.common.scheme.empty())
    throw InvalidOption("name a scheme with -s, or all; `sublimit schemes` lists them");
  if (options.common.mesh.empty()) return refuse_others(options, "schemes"), analyze_schemes(options);
  if (options.common.scheme == "all") throw InvalidOption("a mesh is analysed under one scheme; name it with -s");
  const Source source =
      load_source(options.common, {"analyze", {SourceKind::mesh, SourceKind::patches, SourceKind::normals}, true});
  if (source.has_shapes()) {
    refuse_others(options, "free-form shapes");
    refuse_other_options(source);
    return analyze_shapes(options, source);
  }
  if (options.common.scheme.empty())
    throw InvalidOption(
        "name a scheme with -s; `sublimit schemes` lists them; only an .obj with free-form curves or surfaces and a "
        ".json with recipes need none, and " +
        options.common.mesh + " is none");
  return refuse_others(options, "meshes"), analyze_mesh(options);
}

}  // namespace

Command add_analyze(CLI::App& app) {
  auto* command = app.add_subcommand(
      "analyze", "Report how smooth the limit of a scheme or a mesh is, or how free-form shapes join");
  auto options = std::make_shared<AnalyzeOptions>();
  command->add_option("MESH", options->common.mesh,
                      "A mesh: how smooth its own limit is; an .obj of free-form curves and "
                      "surfaces or a .json of recipes, without -s: how they join; or a curve of Bezier pieces, .csv");
  command->add_option("-s,--scheme", options->common.scheme, "A scheme, or all");
  command->add_option("--valence", options->valences, "Valences, as in 3-12 or 3-8,12")->capture_default_str();
  command->add_option("-o,--output", options->page, "The report as a page, .html");
  command->add_option("--picture", options->picture, "The page's first figure on its own, .svg");
  command->add_option("--json", options->json, "The report as data, .json");
  command->add_option("--tolerance", options->tolerances,
                      "Of seams and joints: g0=1e-9, g1=0.1deg, g2=5%; exit 1 beyond");
  command->add_option("--mask", options->mask, "A curve mask, as in \"1 4 6 4 1 /8\"");
  command->add_option("--sweep", options->sweep, "Smoothness over an option: tension=0:4:0.05");
  command->add_option(
      "--claim", options->claims,
      "What the scheme shall claim instead: extraordinary=2, interpolates=no for no such claim; exit 1 if it is "
      "disproved");
  command->add_option("--export", options->exports,
                      "A directory for local matrices (exact) and characteristic maps (.obj)");
  command->add_option("--option", options->common.options, "An option of the scheme, name=value");
  add_run(*command, options->common);
  add_memory_limit(*command, options->memory_limit);
  command->footer(
      "Examples:\n"
      "  sublimit analyze -s catmull-clark -o report.html\n"
      "  sublimit analyze -s all --valence 3-8 -o report.html --json report.json\n"
      "  sublimit analyze cage.obj -s catmull-clark --tolerance g1=0.1deg -o smooth.html\n"
      "  sublimit analyze teapot.obj --tolerance g1=0.1deg -o teapot.html   (free-form surfaces need no scheme)\n"
      "  sublimit analyze shapes.json -o shapes.html          (recipes: their exact nets, and curve_join, surface_join)\n"
      "  sublimit analyze -s four-point --sweep tension=0:4:0.05 -o sweep.html\n"
      "  sublimit analyze --mask \"1 4 6 4 1 /8\" -o mask.html\n"
      "  sublimit analyze pieces.csv -o joints.html   (header piece,x,y or piece,x,y,z: Bezier control points)");
  return [=] {
    for (const auto& [option, owner] : owners)
      if (command->count(option) > 0) options->given.emplace_back(option);
    for (const char* option : {"--mask", "--sweep"})
      if (command->count(option) > 0) options->given.emplace_back(option);
    return analyze(*options);
  };
}

}  // namespace sublimit::cli

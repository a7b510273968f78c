// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze` of the free-form curves and surfaces in a file.
#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sublimit/report/free_form/free_form_json.h"
#include "sublimit/report/free_form/recipe_report.h"
#include "sublimit/stencils/json/numbers.h"
#include "support/free_form.h"

namespace sublimit::cli {

nlohmann::ordered_json analyze_free_form(const Source& source, const std::vector<std::string>& tolerances,
                                         Progress& progress) {
  const Common& common = source.common;
  FreeFormReportOptions options;
  for (const std::string& tolerance : tolerances) read_tolerance(tolerance, options.tolerance);
  tell_warnings(source);
  progress.step("analysing " + common.mesh);
  nlohmann::ordered_json report = report::report_head("free-form");
  naming_mesh(common, [&] {
    const FreeFormReport found = source.recipes ? recipe_report(*source.recipes, common.mesh, options)
                                                : free_form_report(*source.shapes, common.mesh, options);
    report["free_form"] = to_json(found, std::filesystem::path(common.mesh).filename().string());
  });
  return report;
}

namespace {

std::string order_words(const nlohmann::ordered_json& orders) { return orders.at("says").get<std::string>(); }

/// The joins that recipes ask for, one by one.
void print_asked_joins(const nlohmann::ordered_json& found) {
  for (const char* part : {"seams", "joints"})
    for (const auto& join : found.at(part).at("list")) {
      if (!join.contains("recipe")) continue;
      const auto& exact = join.at("exact");
      fmt::print("  {}: {}measured {}\n", join.at("recipe").get<std::string>(),
                 exact.is_object() ? order_words(exact) + " exactly, " : "", order_words(join.at("measured")));
    }
}

}  // namespace

void print_free_form_report(const nlohmann::ordered_json& report) {
  const nlohmann::ordered_json& found = report.at("free_form");
  const auto text = [](const nlohmann::ordered_json& value) { return value.get<std::string>(); };
  const nlohmann::ordered_json& counts = found.at("counts");
  fmt::print("{}: {} surfaces, {} curves\n", text(found.at("file")), counts.at("surfaces").get<size_t>(),
             counts.at("curves").get<size_t>());
  for (const char* part : {"seams", "joints"})
    if (const auto& verdict = found.at("verdict").at(part); verdict.is_object())
      fmt::print("  {}: {}\n", part, text(verdict.at("says")));
  print_asked_joins(found);
  for (const auto& warning : found.at("warnings")) {
    const std::string where = text(warning.at("where"));
    fmt::print("  {}: {}{}{}\n", text(warning.at("severity")), text(warning.at("says")), where.empty() ? "" : ": ",
               where);
  }
  for (const auto& excess : found.at("beyond")) {
    const bool is_joint = excess.contains("joint");
    const auto& at = excess.at("at");
    fmt::print("  beyond the tolerance: {} {:.3g} at ({:.6g}, {:.6g}, {:.6g}), {} {}\n", text(excess.at("what")),
               excess.at("value").get<double>(), at[0].get<double>(), at[1].get<double>(), at[2].get<double>(),
               is_joint ? "joint" : "seam", excess.at(is_joint ? "joint" : "seam").get<size_t>());
  }
}

}  // namespace sublimit::cli

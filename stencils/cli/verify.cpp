// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "common.h"
#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"
#include "sublimit/table_file.h"
#include "sublimit/verify_table.h"

namespace sublimit::cli {
namespace {

constexpr int negative_verdict = 1;

struct Options {
  Common common;
  std::string table;
};

std::string rows_in_words(const TableInfo& info) {
  switch (info.rows) {
    case TableRows::level:
      return fmt::format("level {}", info.level);
    case TableRows::limit:
      return fmt::format("level {} on the limit", info.level);
    case TableRows::grid:
      return fmt::format("a grid of {0} x {0} places a face", info.grid);
    default:
      return "places of a list";
  }
}

template <class Real>
void describe(const BakedTable<Real>& table) {
  const TableInfo& info = table.info;
  const PatternTable<Real>& t = table.table;
  fmt::print("  {} points from {}: {}, {}{}{}\n", t.num_points(), t.num_control_points(),
             info.scheme.empty() ? "unknown scheme" : info.scheme, rows_in_words(info),
             t.quantities() == 1   ? ""
             : t.quantities() == 3 ? ", first derivatives"
                                   : ", first and second derivatives",
             sizeof(Real) == 4 ? ", float" : ", double");
  std::string options;
  for (const auto& [name, value] : info.options) options += (options.empty() ? "" : ", ") + name + " " + value;
  fmt::print("  {}{}by {}\n", options, options.empty() ? "" : "; ", info.tool.empty() ? "an unknown tool" : info.tool);
  const auto& arrays = t.arrays();
  fmt::print("  {} blocks, {} groups, {} patches, {} weights{}; {}\n", arrays.blocks.size(), arrays.groups.size(),
             t.num_patches(), arrays.weights.size(), arrays.first ? ", a first step by rows" : "",
             bytes_in_words(double(t.num_bytes())));
}

int verify(const Options& options) {
  limit_threads(options.common);
  Progress progress(options.common.quiet);
  progress.step("verifying " + options.table);
  Verification found;
  try {
    found = verify_table(options.table);
  } catch (const FormatError& error) {
    found.findings.push_back(error.what());
  }
  progress.step("");
  for (const std::string& finding : found.findings)
    fmt::print("{}{}\n", finding.starts_with(options.table) ? "" : options.table + ": ", finding);
  if (!found.findings.empty()) return negative_verdict;
  if (options.common.quiet) return 0;
  fmt::print("{}: sound: layout, indices, finite weights, {} row sums, {} checksums, {} arrays, {}\n", options.table,
             found.rows, found.checksums, found.arrays, bytes_in_words(double(found.bytes)));
  std::visit([](const auto& table) { describe(table); }, load_table(options.table));
  return 0;
}

}  // namespace

Command add_verify(CLI::App& app) {
  auto* command = app.add_subcommand("verify", "Whether a table is sound");
  auto options = std::make_shared<Options>();
  command->add_option("TABLE", options->table, "What `sublimit bake` made")->required();
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit verify level3.safetensors\n"
      "Checked: the layout of the file (every tensor within it, no overlaps, no holes, sizes that fit their shapes),\n"
      "indices, that weights are finite, that those of a position sum to one and those of a derivative to zero, that\n"
      "every point is made once, and checksums. Exit status 1 if a check fails, 3 if the file cannot be read.");
  return [=] { return verify(*options); };
}

}  // namespace sublimit::cli

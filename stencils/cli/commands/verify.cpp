// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/verify_table.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/report/analysis/verify_report.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/common.h"
#include "support/input_files.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

constexpr int negative_verdict = 1;

struct VerifyOptions {
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
void describe(Facts& facts, const BakedTable<Real>& table) {
  const TableInfo& info = table.info;
  const PatternTable<Real>& t = table.table;
  const int derivatives = t.quantities() == 1 ? 0 : t.quantities() == 3 ? 1 : 2;
  const char* const with[] = {"", ", first derivatives", ", first and second derivatives"};
  facts.say("  {points} points from {control_points}: {scheme}, {rows}{derivatives}, {precision}\n",
            {{"points", t.num_points()},
             {"control_points", t.num_control_points()},
             {"scheme", info.scheme, info.scheme.empty() ? "unknown scheme" : info.scheme},
             {"rows", rows_in_words(info)},
             {"derivatives", derivatives, with[derivatives]},
             {"precision", sizeof(Real) == 4 ? "float" : "double"}});
  std::string options;
  for (const auto& [name, value] : info.options) options += (options.empty() ? "" : ", ") + name + " " + value;
  if (!options.empty()) options += "; ";
  facts.say("  {options}by {tool}\n", {{"options", info.options, options},
                                       {"tool", info.tool, info.tool.empty() ? "an unknown tool" : info.tool}});
  const auto& arrays = t.arrays();
  facts.say(
      "  {blocks} blocks, {groups} groups, {patches} patches, {weights} weights{first_step_by_rows}; {memory_bytes}\n",
      {{"blocks", arrays.blocks.size()},
       {"groups", arrays.groups.size()},
       {"patches", t.num_patches()},
       {"weights", arrays.weights.size()},
       {"first_step_by_rows", arrays.first.has_value(), arrays.first ? ", a first step by rows" : ""},
       bytes_fact("memory_bytes", double(t.num_bytes()))});
}

/// Findings are printed even where nothing else is.
int print_findings(const VerifyOptions& options, const std::vector<std::string>& findings) {
  const std::string& path = options.table;
  std::string lines;
  for (const std::string& finding : findings) lines += (finding.starts_with(path) ? "" : path + ": ") + finding + "\n";
  Facts facts("verify");
  facts.say("{findings}", {{"file", path}, {"sound", false, ""}, {"findings", findings, lines}});
  Common told = options.common;
  told.quiet = false;
  facts.print(told);
  return negative_verdict;
}

std::string verdicts_in_words(const report::ReportVerification& found) {
  if (found.kind == "curve") return "sound: its joints are what its pieces give";
  if (found.kind != "schemes") return fmt::format("a report of kind {}, which has no verdicts to prove", found.kind);
  std::string text =
      fmt::format("sound: {} verdicts, {} of them proofs with a witness", found.verdicts, found.seen_again);
  if (found.seen_again > 0) text += ", seen again";
  if (found.seen_with_scheme > 0)
    text += fmt::format(" ({} on the masks of the scheme's own file)", found.seen_with_scheme);
  if (found.by_nets > 0) text += fmt::format("; {} are proofs of C^1 by refined nets, which have none", found.by_nets);
  if (found.masks_again > 0)
    text += fmt::format("; {} regular parts and neighbourhoods are what masks give", found.masks_again);
  return text + fmt::format(";\n  {} are proved or disproved without a witness, and {} are not decided", found.decided,
                            found.verdicts - found.decided - found.seen_again - found.by_nets);
}

int verify_report(const VerifyOptions& options) {
  Progress progress(options.common.quiet);
  progress.step("verifying " + options.table);
  report::ReportVerification found;
  try {
    found =
        report::verify_report(read_file(options.table), {.progress = [&](int done, int all) {
                                progress.note(fmt::format("verifying {}: {} of {} parts", options.table, done, all));
                              }});
  } catch (const FormatError& error) {
    throw FormatError(options.table + ": " + error.what());
  }
  progress.step("");
  if (!found.findings.empty()) return print_findings(options, found.findings);
  Facts facts("verify");
  facts.say("{file}: {verdict}\n", {{"file", options.table},
                                    {"sound", true, ""},
                                    {"kind", found.kind},
                                    {"verdict", verdicts_in_words(found)},
                                    {"verdicts", found.verdicts},
                                    {"seen_again", found.seen_again},
                                    {"decided", found.decided}});
  facts.print(options.common);
  return 0;
}

int verify(const VerifyOptions& options) {
  limit_threads(options.common);
  const FileKind kind = file_kind(options.table);
  const bool may_be = !kind.format || reads(*kind.format, contents::tables) || reads(*kind.format, contents::reports);
  if (kind.state == FileKind::State::directory || !may_be)
    return print_findings(options, {fmt::format("it is {}, neither a table nor a report", name_of(kind))});
  if (all_formats().reads(options.table, contents::reports)) return verify_report(options);
  Progress progress(options.common.quiet);
  progress.step("verifying " + options.table);
  Verification found;
  try {
    found = verify_table(options.table);
  } catch (const FormatError& error) {
    found.findings.push_back(error.what());
  }
  progress.step("");
  if (!found.findings.empty()) return print_findings(options, found.findings);
  if (options.common.quiet && !options.common.json) return 0;
  Facts facts("verify");
  facts.say(
      "{file}: sound: layout, indices, finite weights, {row_sums} row sums, {checksums} checksums, {arrays} arrays, "
      "{file_bytes}\n",
      {{"file", options.table},
       {"sound", true, ""},
       {"row_sums", found.rows},
       {"checksums", found.checksums},
       {"arrays", found.arrays},
       bytes_fact("file_bytes", double(found.bytes))});
  std::visit([&](const auto& table) { describe(facts, table); }, load_table(options.table));
  facts.print(options.common);
  return 0;
}

}  // namespace

Command add_verify(CLI::App& app) {
  auto* command = app.add_subcommand("verify", "Check whether a table is sound, or a report proves what it says");
  auto options = std::make_shared<VerifyOptions>();
  command->add_option("TABLE", options->table, "What `sublimit bake` made, or `sublimit analyze --json`")->required();
  add_json(*command, options->common);
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit verify level3.safetensors\n"
      "  sublimit verify report.json\n"
      "  sublimit verify --quiet level3.safetensors && echo sound\n"
      "\nChecked of tables: the layout of the file (every tensor within it, no overlaps, no holes, sizes that fit their shapes),\n"
      "indices, that weights are finite, that those of a position sum to one and those of a derivative to zero, that\n"
      "every point is made once, and checksums.\n"
      "\nChecked of reports: that each witness proves C^1 at its neighbourhood\n"
      "(by a checker of its own, and on the masks of the scheme's file where the scheme is one of ours), that C^1 is\n"
      "nowhere said to be proved without one (but by refined nets, of which there are none yet), that regular parts, types,\n"
      "weights and claims are what masks give (the file's, or of schemes that are not ours those in the report), and that\n"
      "verdicts agree with their hypotheses and with the summary.");
  return [=] { return verify(*options); };
}

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/stencils/files/export_table.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/common.h"

namespace sublimit::cli {
namespace {

struct ExportOptions {
  Common common;
  std::string table, output;
};

int write_export(const ExportOptions& options) {
  // A directory is made, and may be named with a slash at its end.
  const std::filesystem::path output = options.output;
  const bool is_directory = !output.has_extension() && !standard_file(output);
  if (!is_directory) check_output_path(options.output, all_formats().writers({contents::table_rows}));
  limit_threads(options.common);
  Progress progress(options.common.quiet);
  progress.step("reading " + options.table);
  const AnyTable table = load_table(options.table);
  progress.step("writing " + options.output);
  export_table(is_directory && !output.has_filename() ? output.parent_path() : output, table);
  return 0;
}

}  // namespace

Command add_export(CLI::App& app) {
  auto* command = app.add_subcommand("export", "Write a table as a sparse matrix for other programs");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("TABLE", options->table, "What `sublimit bake` made")->required();
  command
      ->add_option("-o,--output", options->output,
                   "OUT.npz (scipy.sparse.load_npz), OUT.mtx (Matrix Market), or a directory of .npy files")
      ->required();
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit export level3.safetensors -o level3.npz\n"
      "  sublimit export level3.safetensors -o level3.mtx\n"
      "  sublimit export level3.safetensors -o level3/\n"
      "\nRows are points in the table's order (all positions, then all derivatives along u, ...), columns control "
      "points.");
  return [=] { return write_export(*options); };
}

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#include "commands/step_job.h"

#include <fmt/core.h>

#include <filesystem>

#include "support/loaded_library.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

CadFileEntry* cad_writer() {
  return reinterpret_cast<CadFileEntry*>(loaded_function(cad_part, opencascade_library, cad_file_entry, "CAD files"));
}

void write_whole_file(const std::string& path, const std::string& text, Progress& progress) {
  AtomicFile file(path, progress.bytes_written());
  file.write(text);
  file.commit();
}

}  // namespace

CadFileEntry* prepare_step(const StepJob& job) {
  check_output_path(job.output, all_formats().writers({contents::cad}));
  if (!job.unit.empty() && !all_formats().writes(job.output, contents::step))
    throw InvalidOption("--unit: only STEP files have a unit of length; " + job.output + " has none");
  if (!job.report.empty()) check_output_path(job.report, all_formats().writers({contents::reports}));
  if (!job.report.empty()) check_not_sidecar("--report", job.report, job.common.mesh);
  return cad_writer();
}

CadFile cad_file_of(const StepJob& job, CadFileEntry* entry, BoundaryModel& model, Progress& progress) {
  model.unit = job.unit == "m" ? LengthUnit::m : job.unit == "inch" ? LengthUnit::inch : LengthUnit::mm;
  progress.step("making a shape");
  CadFile file;
  entry(model, std::filesystem::path(job.output).stem().string(), all_formats().writes(job.output, contents::step),
        file);
  return file;
}

void say_unit(Facts& facts, const StepJob& job) {
  if (!all_formats().writes(job.output, contents::step)) return;
  facts.say("  lengths are in {unit}\n", {{"unit", job.unit.empty() ? "mm" : job.unit,
                                           job.unit.empty() ? "mm; --unit names another unit" : job.unit}});
}

Fact valid_fact(const CadFile& file) {
  return {"valid", file.is_valid, file.is_valid ? "valid" : "not valid by OpenCASCADE's check"};
}

void write_step(const StepJob& job, const CadFile& file, const nlohmann::ordered_json& report, Progress& progress) {
  progress.step("writing " + job.output);
  write_whole_file(job.output, file.bytes, progress);
  if (!job.report.empty()) write_whole_file(job.report, report.dump(2) + "\n", progress);
  progress.step("");
}

}  // namespace sublimit::cli

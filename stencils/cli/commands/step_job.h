// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arguments of `sublimit step`, and its steps that models of meshes and of free-form surfaces share.
#include <nlohmann/json.hpp>

#include "support/source.h"
#include "opencascade/entry.h"

namespace sublimit::cli {

struct StepJob {
  Common common;
  std::string tolerance, join, output, report;
  bool no_packing = false;
};

/// Checks before any work that outputs can be written and that the OpenCASCADE part is there.
/// @return  function that makes files
CadFileEntry* prepare_step(const StepJob& job);

/// Returns the bytes of the CAD file of a model. The product in it has the name of the file.
CadFile cad_file_of(const StepJob& job, CadFileEntry* entry, const BoundaryModel& model, Progress& progress);

/// Writes the CAD file, and the report if the job has a path for it.
void write_step(const StepJob& job, const CadFile& file, const nlohmann::ordered_json& report, Progress& progress);

/// Runs `sublimit step` for free-form surfaces, recipes, and triangles with normals.
/// @return  the exit status
int step_patches(const StepJob& job, const Source& source);

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arguments of `sublimit step`, and its work for models of meshes and of free-form surfaces.
#include <nlohmann/json.hpp>

#include "support/common.h"
#include "opencascade/entry.h"

namespace sublimit::cli {

struct StepJob {
  Common common;
  std::string tolerance, join, output, report;
  bool no_packing = false;
};

/// Fails before any work where outputs cannot be written, or OpenCASCADE is missing.
/// @return  what makes files
CadFileEntry* prepare_step(const StepJob& job);

/// The file's bytes. The product has the file's name.
CadFile cad_file_of(const StepJob& job, CadFileEntry* entry, const BoundaryModel& model, Progress& progress);

/// Writes the file, and the report if one is wanted.
void write_step(const StepJob& job, const CadFile& file, const nlohmann::ordered_json& report, Progress& progress);

/// `step` of free-form surfaces, recipes, and triangles with normals.
/// @return  the exit status
int step_patches(const StepJob& job);

}  // namespace sublimit::cli

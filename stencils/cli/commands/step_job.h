// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arguments of `sublimit step`, and its steps that models of meshes and of free-form surfaces share.
#include <nlohmann/json.hpp>

#include "support/facts.h"
#include "support/source.h"
#include "opencascade/entry.h"

namespace sublimit::cli {

struct StepJob {
  Common common;
  std::string tolerance, join, output, report;
  std::string unit;  ///< empty: mm
  bool no_packing = false;
};

/// Checks before any work that outputs can be written and that the OpenCASCADE part is there.
/// @return  function that makes files
CadFileEntry* prepare_step(const StepJob& job);

/// Gives a model its unit and returns the bytes of its CAD file. The product in it has the name of the file.
CadFile cad_file_of(const StepJob& job, CadFileEntry* entry, BoundaryModel& model, Progress& progress);

/// Writes the CAD file, and the report if the job has a path for it.
void write_step(const StepJob& job, const CadFile& file, const nlohmann::ordered_json& report, Progress& progress);

/// Says the unit of a STEP file.
void say_unit(Facts& facts, const StepJob& job);
/// Returns whether OpenCASCADE found the shape valid.
Fact valid_fact(const CadFile& file);

/// Runs `sublimit step` for free-form surfaces, recipes, and triangles with normals.
/// @return  the exit status
int step_patches(const StepJob& job, const Source& source);

}  // namespace sublimit::cli

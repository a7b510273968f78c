// SPDX-License-Identifier: Apache-2.0
#pragma once
// Implementation of `step` (step.h) without a dependency on OpenCASCADE: this makes models and
// writes files, and the function that converts a model to bytes is an argument. Programs that load OpenCASCADE
// on demand pass the loaded function.
#include <filesystem>
#include <functional>
#include <string>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/step.h"

namespace sublimit {

/// The content of a CAD file and statistics of it.
struct CadFile {
  std::string bytes;           ///< content of the file
  int solids = 0, shells = 0;  ///< closed and open parts
  double volume = 0;           ///< total volume of the solids, from the volumes of their faces
  bool is_valid = false;       ///< result of OpenCASCADE's own check
};

/// Function that converts a model to the bytes of a file, see `cad_file`.
using CadFileMaker = std::function<CadFile(const BoundaryModel& model, const std::string& name, bool step)>;

/// Checks path and options, as `step` does before any work.
/// @throws InvalidOption     another extension than .step, .stp or .brep
/// @throws InvalidParameter  a tolerance that is not positive
void check_step(const std::filesystem::path& path, const StepOptions& options);

/// Writes a limit surface, see `step`.
/// @param make  called once, with the finished model
/// @throws the errors of `step` and of `make`
StepFile write_step(const LimitSurface& surface, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make);
/// Writes classical patches, see `step`.
StepFile write_step(const Patches& patches, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make);

}  // namespace sublimit

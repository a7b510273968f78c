// SPDX-License-Identifier: Apache-2.0
#pragma once
// Implementation of `step` (opencascade/step.h) without a dependency on OpenCASCADE: this makes models and
// writes files, and the function that converts a model to bytes is an argument. Programs that load OpenCASCADE
// on demand pass the loaded function.
#include <filesystem>
#include <functional>
#include <string>

#include "sublimit/cad/opencascade/step.h"
#include "sublimit/cad/opencascade/write_cad.h"

namespace sublimit {

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

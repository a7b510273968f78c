// SPDX-License-Identifier: Apache-2.0
#pragma once
// `step` of opencascade/step.h without OpenCASCADE: models and files are made here, and what makes bytes of a model is
// an argument. A program that loads OpenCASCADE when it is wanted gives what it has loaded.
#include <filesystem>
#include <functional>
#include <string>

#include "sublimit/cad/opencascade/step.h"
#include "sublimit/cad/opencascade/write_cad.h"

namespace sublimit {

/// Makes the bytes of a file, as `cad_file`.
using CadFileMaker = std::function<CadFile(const BoundaryModel& model, const std::string& name, bool step)>;

/// Checks what `step` checks before any work.
/// @throws InvalidOption     another extension than .step, .stp or .brep
/// @throws InvalidParameter  a tolerance that is not positive
void check_step(const std::filesystem::path& path, const StepOptions& options);

/// Writes a limit surface, as `step`.
/// @param make  called once, with the finished model
/// @throws as `step`, and what `make` throws
StepFile write_step(const LimitSurface& surface, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make);
/// Writes classical patches, as `step`.
StepFile write_step(const Patches& patches, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make);

}  // namespace sublimit

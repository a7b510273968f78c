// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/step.h"

#include "sublimit/cad/opencascade/write_cad.h"
#include "sublimit/cad/step_file.h"

namespace sublimit {

StepFile step(const LimitSurface& surface, const std::filesystem::path& path, const StepOptions& options) {
  return write_step(surface, path, options, cad_file);
}

StepFile step(const Patches& patches, const std::filesystem::path& path, const StepOptions& options) {
  return write_step(patches, path, options, cad_file);
}

}  // namespace sublimit

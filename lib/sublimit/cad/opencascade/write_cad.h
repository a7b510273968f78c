// SPDX-License-Identifier: Apache-2.0
#pragma once
// Formats a boundary model as a file that CAD programs read: .step (ISO 10303-214) or .brep (OpenCASCADE's own). Link
// sublimit::cad. With `model` a BoundaryModel:
//
//   const CadFile made = cad_file(model, "bracket", true);
//   std::ofstream("bracket.step", std::ios::binary) << made.bytes;
#include <string>

#include "sublimit/cad/step_file.h"

namespace sublimit {

/// Returns a model as the content of a file.
/// @param name  name of the product in the file
/// @param step  true for STEP, false for BREP
/// @throws InvalidMesh     a model that OpenCASCADE refuses
/// @throws std::bad_alloc  OpenCASCADE is out of memory
CadFile cad_file(const BoundaryModel& model, const std::string& name, bool step);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Boundary models as files of CAD programs: .step (ISO 10303-214) and .brep (OpenCASCADE's own).
#include <string>

#include "sublimit/cad/boundary_model.h"

namespace sublimit {

struct CadFile {
  std::string bytes;
  int solids = 0, shells = 0;  ///< closed and open
  double volume = 0;           ///< of all solids, by that of their faces
  bool is_valid = false;       ///< as OpenCASCADE's own check has it
};

/// @param name  of the product
/// @throws InvalidMesh     what OpenCASCADE refuses
/// @throws std::bad_alloc  it has no memory
CadFile cad_file(const BoundaryModel& model, const std::string& name, bool step);

}  // namespace sublimit

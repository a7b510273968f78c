// SPDX-License-Identifier: Apache-2.0
#pragma once
// A boundary model as a shape of OpenCASCADE.
#include <TopoDS_Shape.hxx>

#include "sublimit/cad/boundary_model.h"

namespace sublimit {

struct ModelShape {
  TopoDS_Shape shape;  ///< a solid, a shell, or a compound of several
  int solids = 0, shells = 0;
  bool is_valid = false;  ///< as OpenCASCADE's own check has it
};

/// Faces that share edges are a shell; a shell without borders is a solid, whose faces look outwards.
ModelShape shape_of(const BoundaryModel& model);

}  // namespace sublimit

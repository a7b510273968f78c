// SPDX-License-Identifier: Apache-2.0
#pragma once
// A boundary model as a shape of OpenCASCADE.
#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

#include "sublimit/cad/boundary_model.h"

namespace sublimit {

struct ModelShape {
  /// A solid or a shell, by the name that all of its faces have.
  struct Part {
    TopoDS_Shape shape;
    std::string name;
  };
  TopoDS_Shape shape;  ///< a solid, a shell, or a compound of several
  std::vector<Part> parts;
  std::vector<TopoDS_Shape> faces;  ///< of the model, in its order
  int solids = 0, shells = 0;
  double volume = 0;      ///< of all solids
  bool is_valid = false;  ///< as OpenCASCADE's own check has it
};

/// Faces that share edges are a shell; one without borders that bounds a volume is a solid, whose faces look
/// outwards.
ModelShape shape_of(const BoundaryModel& model);

}  // namespace sublimit

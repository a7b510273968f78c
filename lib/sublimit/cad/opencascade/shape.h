// SPDX-License-Identifier: Apache-2.0
#pragma once
// Converts a boundary model into shapes of OpenCASCADE, for programs that go on with its modelling kernel. Link
// sublimit::cad. With `model` a BoundaryModel:
//
//   const ModelShape made = shape_of(model);
//   if (!made.is_valid) std::cerr << "OpenCASCADE finds faults in the shape\n";
//   for (const ModelShape::Part& part : made.parts) std::cout << part.name << "\n";
#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

#include "sublimit/cad/boundary_model.h"

namespace sublimit {

/// The shapes that a boundary model becomes. Plain data.
struct ModelShape {
  /// A solid or a shell, with the name that all of its faces have; empty if they have several.
  struct Part {
    TopoDS_Shape shape;
    std::string name;
  };
  TopoDS_Shape shape;               ///< a solid, a shell, or a compound of several
  std::vector<Part> parts;          ///< solids and shells
  std::vector<TopoDS_Shape> faces;  ///< one for each face of the model, in its order
  int solids = 0, shells = 0;       ///< closed and open parts
  double volume = 0;                ///< total volume of the solids
  bool is_valid = false;            ///< result of OpenCASCADE's own check (BRepCheck_Analyzer)
};

/// Returns the shapes of a model. Faces that share edges become a shell; a shell without borders that bounds a volume
/// becomes a solid, whose faces are oriented outwards.
ModelShape shape_of(const BoundaryModel& model);

}  // namespace sublimit

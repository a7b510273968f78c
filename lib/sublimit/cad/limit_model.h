// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface as a boundary representation: exact B-spline faces, as large as they can be, and caps around
// extraordinary vertices.
#include <functional>
#include <string>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/measure.h"

namespace sublimit {

struct LimitModelOptions {
  double tolerance = 0;        ///< of caps: largest distance from the limit, > 0
  bool join_smoothly = false;  ///< as `LimitQuadOptions` has it
  bool pack = true;
  Mesh::FaceNames face_names = {};  ///< of the mesh, to be those of faces: only faces of one name are packed
  std::int64_t max_faces = std::int64_t{1} << 17;
  std::function<void(const std::string& what)> progress;
};

struct LimitModel {
  BoundaryModel boundary;
  std::int64_t quads = 0, caps = 0;  ///< before packing; caps among them
  double deviation = 0;              ///< of caps from the limit, measured
  bool met = true;                   ///< the tolerance
  QuadMeasures measures;
};

/// Makes the model of a surface without its holes. The result does not depend on the number of threads.
/// @param points  of the level, #V x 3
/// @throws InvalidParameter, UnsupportedTopology  as `limit_quads`
/// @throws InvalidParameter  names that are not one for each face of the mesh
/// @throws ResourceError  more faces than allowed
LimitModel limit_model(const LimitMap& surface, const Points& points, const LimitModelOptions& options);

}  // namespace sublimit

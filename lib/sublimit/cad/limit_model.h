// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit surfaces as boundary representations: exact B-spline faces, as large as possible, and caps around
// extraordinary vertices.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/measure.h"

namespace sublimit {

/// Options of `limit_model`.
struct LimitModelOptions {
  double tolerance = 0;             ///< largest distance of caps from the limit, > 0
  bool join_smoothly = false;       ///< see `LimitQuadOptions`
  bool pack = true;                 ///< true: merge quads into larger faces
  Mesh::FaceNames face_names = {};  ///< names of the mesh's faces; only faces of the same name are merged
  /// Values of the mesh's faces: red, green and blue are their colours; only faces of the same colour are merged.
  std::vector<Mesh::Values> face_values = {};
  std::int64_t max_faces = std::int64_t{1} << 17;  ///< largest number of faces of the model
  std::function<void(const std::string& what)> progress;
};

/// A model with its statistics.
struct LimitModel {
  BoundaryModel boundary;
  std::int64_t quads = 0, caps = 0;  ///< number of quads before packing, and of caps among them
  double deviation = 0;              ///< measured deviation of caps from the limit
  bool met = true;                   ///< true if all caps are within the tolerance
  QuadMeasures measures;
};

/// Returns the model of a surface without its holes. The result does not depend on the number of threads.
/// @param points  points of the surface's level, #V x 3
/// @throws InvalidParameter, UnsupportedTopology  see `limit_quads`
/// @throws InvalidParameter  another number of names or colours than faces of the mesh
/// @throws ResourceError     more than `max_faces` faces
LimitModel limit_model(const LimitMap& surface, const Points& points, const LimitModelOptions& options);

}  // namespace sublimit

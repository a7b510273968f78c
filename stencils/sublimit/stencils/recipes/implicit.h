// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes whose limit is the zero level set of a field. A program that calls `implicit` links
// sublimit::implicit_mesh too, which needs OpenVDB; `implicit_mesh` takes another polygoniser:
//
//   const ImplicitMesh torus = implicit("torus.json", "catmull-clark", {.tolerance = 1e-3});
//   if (torus.met) write_mesh("torus.obj", torus.mesh);
#include <functional>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/any_scheme.h"

namespace sublimit {

struct FieldGrid;

/// Options of `implicit`.
struct ImplicitOptions {
  /// Cells along the longest side of the box, 4 or more; 0: as the recipe says, else as few as meet the tolerance.
  int cells = 0;
  double tolerance = 0;  ///< largest distance of the limit from the level set; 0: 1e-4 of the box's diagonal
  std::function<void(const std::string&)> progress = {};  ///< called with a description of each step, if given
};

/// A control mesh whose limit is near the level set. Plain data.
struct [[nodiscard]] ImplicitMesh {
  Mesh mesh;                       ///< closed, with creases and corners where the field has sharp edges
  bool met = false;                ///< true if the limit is within the tolerance and no face is folded
  double tolerance = 0;            ///< tolerance that was given, or its default
  double largest_distance = 0;     ///< largest distance of sampled points of the limit from the level set
  double mean_distance = 0;        ///< mean distance of these points
  std::vector<std::string> notes;  ///< warnings
};

/// Fits the limit of a control mesh to the zero level set of a field F.
/// @param field       path of a .json file; or the JSON itself, which begins with {
/// @param scheme      scheme of the limit
/// @param polygonize  returns closed quadrilaterals around {F < 0} of a sampled field
/// @throws FormatError, IoError  as `construct`
/// @throws InvalidMesh           the level set nearly touches itself
/// @throws InvalidParameter      a tolerance that is negative or not finite, cells below 4
/// @throws ResourceError         not enough memory for the grid
ImplicitMesh implicit_mesh(const std::string& field, const AnyScheme& scheme,
                           const std::function<Mesh(const FieldGrid&)>& polygonize, const ImplicitOptions& options);

/// Returns quads around a sampled field, by OpenVDB: in the component implicit_mesh.
/// @throws ResourceError  more vertices than 32-bit indices count
Mesh polygonize(const FieldGrid& grid);

/// Returns a control mesh whose limit is the level set 0 of a field, as `implicit_mesh`, by OpenVDB.
/// @throws as `implicit_mesh`
inline ImplicitMesh implicit(const std::string& field, const AnyScheme& scheme = "catmull-clark",
                             const ImplicitOptions& options = {}) {
  return implicit_mesh(
      field, scheme, [](const FieldGrid& grid) { return polygonize(grid); }, options);
}

}  // namespace sublimit

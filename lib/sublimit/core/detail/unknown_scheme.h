// SPDX-License-Identifier: Apache-2.0
#pragma once
// Errors for names that a registry of schemes does not have.
#include <string>

namespace sublimit {

/// Registries, by the data that their schemes refine.
enum class SchemeKind {
  surface,         ///< `scheme`, `find_scheme`: meshes, by matrices
  curve,           ///< `curve_scheme`, `find_curve_scheme`: polygons, by matrices
  polygon,         ///< `geometric_scheme<ControlPolygon>`: polygons with tangents, without a matrix
  curvature_mesh,  ///< `geometric_scheme<CurvatureMesh>`
  normal_mesh,     ///< `geometric_scheme<NormalMesh>`
};

/// Throws for a name that is not in registry `wanted`. The message names the function that makes it if another
/// registry has it, else the nearest names of this one.
/// @throws InvalidOption  always
[[noreturn]] void throw_unknown_scheme(const std::string& name, SchemeKind wanted);

/// Throws for a name that is no surface scheme, with a message that is independent of the programming language:
/// says what accepts it if another registry has it, else the nearest names of all registries.
/// @throws InvalidOption  always
[[noreturn]] void throw_no_surface_scheme(const std::string& name);

}  // namespace sublimit

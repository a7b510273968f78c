// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is said of a name that a registry of schemes does not have.
#include <string>

namespace sublimit {

/// The registries, by what their schemes refine.
enum class SchemeKind {
  surface,         ///< `scheme`, `find_scheme`: meshes, by matrices
  curve,           ///< `curve_scheme`, `find_curve_scheme`: polygons, by matrices
  polygon,         ///< `geometric_scheme<ControlPolygon>`: polygons with tangents, without a matrix
  curvature_mesh,  ///< `geometric_scheme<CurvatureMesh>`
  normal_mesh,     ///< `geometric_scheme<NormalMesh>`
};

/// Throws for a name that is not one of `wanted`: names the function that makes it where another registry has it, else
/// the nearest names of this one.
/// @throws InvalidOption  always
[[noreturn]] void throw_unknown_scheme(const std::string& name, SchemeKind wanted);

/// Throws for a name that is no scheme of surfaces, in words for any language: what takes it where another registry has
/// it, else the nearest names of all.
/// @throws InvalidOption  always
[[noreturn]] void throw_no_surface_scheme(const std::string& name);

}  // namespace sublimit

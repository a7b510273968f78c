// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces through points and normals on the command line: schemes without a matrix on meshes of triangles, with the
// normals of an OBJ; or recipes of such surfaces, which name them by their kinds.
#include "support/common.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/geometric/placed_surface.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit::cli {

/// Returns true if `common.scheme` names such a scheme, or all surfaces of a file of recipes are such. They are left
/// out of files that have linear surfaces too.
bool is_normal_job(const Common& common);

/// @throws InvalidOption  options that are of subdivision schemes or curves, unknown options of the scheme
void check_normal_job(const Common& common, bool closed);

struct NormalSurface {
  Common common;  ///< mesh and scheme, for messages
  GeometricNormalScheme scheme;
  NormalMesh data;  ///< checked
};

/// Reads mesh and normals, or the meshes and triangles of all recipes, in their order; prints what they are worth a
/// note for.
/// @throws InvalidMesh, UnsupportedTopology  what the scheme cannot take, with the name of the mesh or recipe
/// @throws FormatError, IoError              meshes that recipes name, which cannot be read
std::vector<NormalSurface> load_normal_surfaces(const Common& common, Progress& progress);
/// Loads the surface of a recipe of kind `nielson` or `piper`.
NormalSurface load_normal_surface(const Common& common, const Recipe& recipe, Progress& progress);

/// Why the scheme does not take the mesh; empty if it does.
std::string why_no_normal_surface(const Common& common, const Mesh& mesh);

/// Arguments of `refine` and `limit`, which write points of the surface.
struct NormalJob {
  const Common* common;
  int levels = 0;
  std::string output, matrix;  ///< matrix may be empty
  bool normals = true;         ///< write them
};
int write_normal_surface(const NormalJob& job);

}  // namespace sublimit::cli

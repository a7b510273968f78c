// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces through points and normals on the command line: nonlinear schemes on triangle meshes with the
// normals of an OBJ, or recipes of the kinds `nielson` and `piper`.
#include "support/source.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/geometric/placed_surface.h"

namespace sublimit::cli {

struct NormalSurface {
  Common common;  ///< mesh and scheme, for messages
  GeometricNormalScheme scheme;
  NormalMesh data;  ///< checked
};

/// Reads mesh and normals, or the meshes and triangles of all recipes in their order, and prints notes on them.
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme does not take; the message names it or its
///                                           recipe
/// @throws FormatError, IoError              a mesh of a recipe that cannot be read
std::vector<NormalSurface> load_normal_surfaces(const Source& source, Progress& progress);
/// Loads the surface of a recipe of kind `nielson` or `piper`.
NormalSurface load_normal_surface(const Common& common, const Recipe& recipe, Progress& progress);

/// Returns the reason why the scheme does not take a mesh; empty if it does.
std::string why_no_normal_surface(const Common& common, const Mesh& mesh);

/// Arguments of `refine` and `limit`, which write points of the surface.
struct NormalJob {
  const Source* source;
  int levels = 0;
  std::string output, matrix;  ///< matrix may be empty
  bool normals = true;         ///< write them
  const char* verb = "limit";  ///< for facts
};
int write_normal_surface(const NormalJob& job);

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
// What stands where MESH may stand: found once, from the name of the scheme and the file.
//
//   const Source source = load_source(options.common, {"closest", {SourceKind::mesh, SourceKind::patches}});
//   if (source.kind == SourceKind::patches) ...
#include <optional>
#include <string>
#include <vector>

#include "support/common.h"
#include "sublimit/io/free_form.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit::cli {

/// Kinds of sources, by what can be computed of them. A new kind has a row in source.cpp.
enum class SourceKind {
  mesh,        ///< a mesh, under a scheme with masks
  curves,      ///< a polygon, under a scheme of curves
  normals,     ///< a surface through points with normals: `-s nielson` or `piper`, or recipes of these kinds alone
  curvatures,  ///< a mesh under a scheme that takes normals and curvatures, as `-s torus-pieces`
  patches,     ///< a free-form .obj or a file of recipes, linear in its control points; without a scheme
};

/// A source. Recipes and free-form shapes are loaded, without printing their warnings; a mesh is loaded by `load`, a
/// polygon by `load_polygon`.
struct Source {
  Common common;
  SourceKind kind = SourceKind::mesh;
  std::optional<std::vector<Recipe>> recipes;  ///< of a .json
  std::optional<FreeForm> shapes;              ///< of an .obj with curves or surfaces

  /// Returns true if the file needs no scheme.
  bool has_shapes() const { return recipes || shapes; }
  /// Returns true if the file has curves but no surfaces.
  bool has_curves_alone() const;
};

/// What a subcommand takes.
struct Takes {
  const char* verb;
  std::vector<SourceKind> kinds;
  bool scheme_optional = false;  ///< a mesh without a scheme too, and options of meshes beside shapes
};

/// Finds what the arguments name, and checks that the subcommand takes it and that options are those of its kind.
/// @throws InvalidOption        an unknown scheme; none, for a mesh; an option of another kind of source; a kind that
///                              the subcommand does not take: says which it takes
/// @throws UnsupportedTopology  recipes of a kind that the subcommand does not take
/// @throws Error                as `read_recipes` and `read_free_form`
Source load_source(const Common& common, const Takes& takes);

/// Checks that options are those of the kind of source.
/// @throws InvalidOption  another option
void refuse_other_options(const Source& source);

}  // namespace sublimit::cli

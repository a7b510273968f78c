// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lists the schemes of the library with their properties and options.
//
//   for (const SchemeInfo& scheme : schemes()) std::cout << scheme.name << ": " << scheme.limit << "\n";
#include <optional>
#include <string>
#include <vector>

#include "sublimit/core/scheme_options.h"

namespace sublimit {

/// Properties of a scheme. Numbers are claims of its authors, which reports check; absent if nothing is claimed. Plain
/// data.
struct SchemeInfo {
  enum class Kind { surface, curve };
  std::string name;
  Kind kind = Kind::surface;                         ///< refines meshes, or polygons
  bool linear = true;                                ///< has masks, and all that is computed from them
  std::string source;                                ///< author, year, title
  std::string limit;                                 ///< regular limit, in words
  bool interpolates = false;                         ///< control points stay
  bool triangles = false;                            ///< takes triangles only
  std::optional<int> continuity = {};                ///< the limit is C^continuity, for surfaces on regular meshes
  std::optional<int> extraordinary_continuity = {};  ///< continuity of surfaces at extraordinary vertices
  std::optional<int> generates_degree = {};          ///< polynomials up to this degree are limits
  std::optional<int> reproduces_degree = {};         ///< polynomials up to this degree are limits of their own values
  std::optional<bool> convex_hull = {};              ///< no negative weights
  std::vector<OptionInfo> options = {};              ///< options that `AnyScheme` takes
};

/// Returns all schemes, those of surfaces first, in the order of the program's list.
std::vector<SchemeInfo> schemes();

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Laws that every scheme obeys, as functions: the tests run them over the registry with options, and over mutants,
// which must break one.
#include <string>
#include <utility>
#include <vector>

#include "sublimit/scheme/scheme.h"

namespace sublimit::testing {

struct Law {
  std::string name;
  /// Returns a description of a violation; empty if the scheme obeys the law.
  std::string (*violation)(const Scheme<double>& scheme);
};

const std::vector<Law>& laws();

/// A side of a vertex at which limits_agree_between_levels compares normals, unless there is none.
struct NormalPlace {
  Index mesh = 0;  ///< number among the laws' meshes for the scheme
  int level = 0;
  Index vertex = 0;
  Index faces = 0;         ///< faces of the side
  Index from_faces = 0;    ///< faces of its ancestor vertex on level 0; `faces` if it has none
  bool one_sided = false;  ///< true if the vertex is on the border or on sharp edges
  bool corner = false;     ///< true if the vertex is also a corner, which does not move
  bool defined = false;    ///< true if the library has a normal
};
/// Returns all sides on levels 0 and 1 of the laws' meshes.
std::vector<NormalPlace> normal_places(const Scheme<double>& scheme);

/// Returns names and options: every scheme with its default options, then with others that change its masks.
std::vector<std::pair<std::string, SchemeOptions>> scheme_names_and_options();

/// Returns a variant as on a command line: `butterfly --option tension=0`.
std::string described(const std::pair<std::string, SchemeOptions>& variant);

}  // namespace sublimit::testing

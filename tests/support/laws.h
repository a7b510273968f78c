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
  /// Empty if the scheme obeys, else what is wrong.
  std::string (*violation)(const Scheme<double>& scheme);
};

const std::vector<Law>& laws();

/// A side of a vertex: where limits_agree_between_levels compares normals, or cannot, because there is none.
struct NormalPlace {
  Index mesh = 0;  ///< of the laws' meshes for the scheme
  int level = 0;
  Index vertex = 0;
  Index faces = 0;         ///< of the side
  Index from_faces = 0;    ///< of the vertex of level 0 that it comes from; as `faces` if it comes from none
  bool one_sided = false;  ///< the vertex is on the border or on sharp edges
  bool corner = false;     ///< and stays where it is
  bool defined = false;    ///< the library has a normal
};
/// All sides on levels 0 and 1 of the laws' meshes.
std::vector<NormalPlace> normal_places(const Scheme<double>& scheme);

/// Names and options: every scheme with its default options, then with others that change its masks.
std::vector<std::pair<std::string, SchemeOptions>> scheme_names_and_options();

/// `butterfly --option tension=0`, as one writes it.
std::string described(const std::pair<std::string, SchemeOptions>& variant);

}  // namespace sublimit::testing

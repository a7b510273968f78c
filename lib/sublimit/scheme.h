// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scheme: masks and the split they belong to, nothing else. Everything that the library says about a scheme (refined
// meshes, limits, tangents) is computed from the matrices that these masks fill. A scheme in a file of your own program
// gets all that ours get.
#include <map>
#include <string>
#include <vector>

#include "sublimit/sites.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// One split and its masks. Schemes of several steps (repeated averaging) multiply their matrices.
template <class T>
struct Step {
  Split split;
  Masks<T> masks;
};

/// What a scheme is said to do, each claim with its law in the tests.
struct Claims {
  int regular = 0;         ///< the limit is C^regular on regular meshes
  int extraordinary = 0;   ///< and C^extraordinary at extraordinary points
  int reproduces = 1;      ///< polynomials of this degree are reproduced on regular meshes
  bool convex_hull = false;    ///< no negative weights
  bool interpolates = false;   ///< old vertices stay
  std::string limit;           ///< of regular meshes, in words
};

/// Options by name, as on the command line: `triangles=smooth`.
using SchemeOptions = std::map<std::string, std::string>;

/// An option that a scheme understands.
struct OptionInfo {
  std::string name;
  std::vector<std::string> values;  ///< the first is the default
};

template <class T>
struct Scheme {
  std::string name;
  std::string source;  ///< author, year, title
  std::vector<Step<T>> steps;
  CreaseMasks<T> creases;
  Claims claims;
  std::vector<OptionInfo> options = {};
  /// The masks repeat with this period in the level; 1 for stationary schemes.
  int period = 1;

  /// Corners of the faces it takes, 0 for any.
  int face_size() const { return steps[0].split == Split::ptq ? 3 : 0; }
};

/// Value of an option, its default if absent.
/// @throws InvalidOption  a value that is not among `info.values`
std::string option(const SchemeOptions& options, const OptionInfo& info);

}  // namespace sublimit

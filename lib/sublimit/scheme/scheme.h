// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scheme: masks and the split they belong to, nothing else. Everything that the library says about a scheme (refined
// meshes, limits, tangents) is computed from the matrices that these masks fill. A scheme in a file of your own program
// gets all that ours get.
#include <string>
#include <vector>

#include "sublimit/core/scheme_options.h"
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/scheme/sites.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// One split and its masks. Schemes of several steps (repeated averaging) multiply their matrices.
template <class T>
struct Step {
  Split split;
  Masks<T> masks;
  CreaseMasks<T> creases = {};  ///< where they differ from the scheme's
};

/// What may be sharp besides the boundary.
enum class Sharpening {
  boundary,    ///< nothing: the scheme has no rule for sharp edges inside
  sharp,       ///< edges and vertices that never get smooth: they cut the surface, each side has the boundary's rules
  semi_sharp,  ///< any sharpness
};

/// Properties that a scheme is said to have. No result depends on them: reports judge them, and tests check each.
struct Claims {
  int regular = 0;            ///< the limit is C^regular on regular meshes
  int extraordinary = 0;      ///< and C^extraordinary at extraordinary points
  int generates = 1;          ///< polynomials up to this degree are limits of regular meshes
  int reproduces = 1;         ///< they are the limits of their own values at the vertices
  bool convex_hull = false;   ///< no negative weights
  bool interpolates = false;  ///< old vertices stay
  std::string limit;          ///< of regular meshes, in words
};

template <class T>
struct Scheme {
  std::string name;
  std::string source;  ///< author, year, title
  std::vector<Step<T>> steps;
  CreaseMasks<T> creases;
  Claims claims = {};
  std::vector<OptionInfo> options = {};  ///< options that it understands
  SchemeOptions chosen = {};             ///< options that were given; the others have their defaults
  /// Levels after which a neighbourhood has its old orientation: 1, or 2 for schemes that rotate (sqrt3, mid_edge).
  int period = 1;
  Sharpening sharpening = Sharpening::semi_sharp;
  /// Where new knots are inserted, for schemes whose masks use knot intervals.
  NewKnots knots = NewKnots::none;
  /// Corners of the faces that it takes; 0 for any, or what its split takes.
  int corners = 0;
  /// Steps that turn a control mesh with other faces than `corners` into one with such faces, before level 1.
  std::vector<Step<T>> preparation = {};

  int face_size() const {
    return corners                                                          ? (preparation.empty() ? corners : 0)
           : steps[0].split == Split::ptq || steps[0].split == Split::sqrt3 ? 3
                                                                            : 0;
  }
  /// How much finer a mesh is after one period.
  int dilation() const { return steps[0].split == Split::sqrt3 ? 3 : 2; }
  /// Faces around a vertex of a regular mesh.
  int regular_valence() const { return face_size() == 3 ? 6 : 4; }
  /// Steps of one level.
  std::vector<Step<T>> steps_at(int level, const Topology& topology) const {
    if (level > 0 || preparation.empty() || topology.uniform_face_size() == corners) return steps;
    std::vector<Step<T>> all = preparation;
    all.insert(all.end(), steps.begin(), steps.end());
    return all;
  }
  /// True if masks use points beyond the faces of their element.
  bool is_wide() const {
    for (const Step<T>& step : steps)
      if (step.masks.wide_edge || step.masks.wide_face) return true;
    return false;
  }
  /// True if limits of vertices depend on the faces around them alone.
  bool has_one_ring_limits() const {
    return steps.size() == 1 && preparation.empty() && period == 1 && !is_wide() &&
           (steps[0].split == Split::pqq || steps[0].split == Split::ptq);
  }
  /// True if vertices have no child vertices: their limit is that of the face, or border edge, that they become.
  bool is_dual() const {
    for (const Step<T>& step : steps)
      if (step.split == Split::dqq || step.split == Split::mid_edge || step.split == Split::dual) return true;
    return false;
  }
};

}  // namespace sublimit

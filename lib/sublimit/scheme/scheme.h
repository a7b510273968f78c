// SPDX-License-Identifier: Apache-2.0
#pragma once
// Schemes: masks and the split they belong to, nothing else. Everything that the library computes for a scheme (refined
// meshes, limits, tangents, reports) follows from the matrices that these masks fill, for schemes of your own too:
//
//   const auto vertex = [](const Ring<double>& v) { return (v.center() + v.neighbor_mean()) / 2; };
//   const auto edge = [](const EdgeSite<double>& e) { return (e.tail() + e.head()) / 2; };
//   const auto face = [](const FaceSite<double>& f) { return f.centroid(); };
//   const std::vector<Step<double>> steps = {{Split::pqq, {.vertex = vertex, .edge = edge, .face = face}}};
//   const Scheme<double> mine = {"mine", "here", steps, cubic_bspline_creases<double>()};
//   const Limit limit = sublimit::limit(mesh, mine);
#include <string>
#include <vector>

#include "sublimit/core/scheme_options.h"
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/scheme/sites.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// One split and its masks. A level of a scheme with several steps (repeated averaging) is the product of their
/// matrices.
template <class T>
struct Step {
  Split split;
  Masks<T> masks;
  CreaseMasks<T> creases = {};  ///< if they differ from the scheme's
};

/// Elements that may be sharp besides the boundary.
enum class Sharpening {
  boundary,    ///< none: the scheme has no rule for sharp edges inside
  sharp,       ///< edges and vertices of infinite sharpness: they cut the surface, each side has the boundary's rules
  semi_sharp,  ///< any sharpness
};

/// Properties that a scheme is said to have. No result depends on them: reports and tests check each.
struct Claims {
  int regular = 0;            ///< the limit is C^regular on regular meshes
  int extraordinary = 0;      ///< and C^extraordinary at extraordinary points
  int generates = 1;          ///< polynomials up to this degree are limits of regular meshes
  int reproduces = 1;         ///< polynomials up to this degree are the limits of their values at the vertices
  bool convex_hull = false;   ///< no negative weights
  bool interpolates = false;  ///< old vertices stay
  std::string limit;          ///< limit of regular meshes, in words
};

/// A subdivision scheme in numbers of type T. Threads may share one whose masks may be called by several threads, as
/// those of the library may.
template <class T>
struct Scheme {
  std::string name = {};
  std::string source = {};  ///< author, year, title
  std::vector<Step<T>> steps = {};
  CreaseMasks<T> creases = {};
  Claims claims = {};
  std::vector<OptionInfo> options = {};  ///< options of the scheme
  SchemeOptions chosen = {};             ///< options that were given; others have their defaults
  /// Levels after which a neighbourhood has its old orientation: 1, or 2 for schemes that rotate (sqrt3, mid_edge).
  int period = 1;
  Sharpening sharpening = Sharpening::semi_sharp;
  /// Where new knots are inserted, for schemes whose masks use knot intervals.
  NewKnots knots = NewKnots::none;
  /// Corners of the faces that the steps take; 0: any, or those that the split needs.
  int corners = 0;
  /// Steps that turn a control mesh with other faces than `corners` into one with such faces, before level 1.
  std::vector<Step<T>> preparation = {};

  /// Returns the corners of the faces that a control mesh must have; 0: any.
  int face_size() const {
    return corners                                                          ? (preparation.empty() ? corners : 0)
           : steps[0].split == Split::ptq || steps[0].split == Split::sqrt3 ? 3
                                                                            : 0;
  }
  /// Returns the factor by which edges of a regular mesh get shorter in one period.
  int dilation() const { return steps[0].split == Split::sqrt3 ? 3 : 2; }
  /// Returns the number of faces around a vertex of a regular mesh.
  int regular_valence() const { return face_size() == 3 ? 6 : 4; }
  /// Returns the steps from a level to the next: those of level 0 include the preparation, if its faces need it.
  std::vector<Step<T>> steps_at(int level, const Topology& topology) const {
    if (level > 0 || preparation.empty() || topology.uniform_face_size() == corners) return steps;
    std::vector<Step<T>> all = preparation;
    all.insert(all.end(), steps.begin(), steps.end());
    return all;
  }
  /// True if masks depend on points beyond the faces of their element.
  bool is_wide() const {
    for (const Step<T>& step : steps)
      if (step.masks.wide_edge || step.masks.wide_face) return true;
    return false;
  }
  /// True if limits of vertices depend only on the faces around them.
  bool has_one_ring_limits() const {
    return steps.size() == 1 && preparation.empty() && period == 1 && !is_wide() &&
           (steps[0].split == Split::pqq || steps[0].split == Split::ptq);
  }
  /// True if vertices have no child vertices: their limit is that of the face, or border edge, that replaces them.
  bool is_dual() const {
    for (const Step<T>& step : steps)
      if (step.split == Split::dqq || step.split == Split::mid_edge || step.split == Split::dual) return true;
    return false;
  }
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classical curves and surfaces from a free-form .obj, or from recipes: JSON objects of a `kind`, which `sublimit
// construct --help` lists; errors name the fields of a kind. Rational ones have `homogeneous` columns
// (w x, w y, w z, w):
//
//   const Construction cone = construct("cone.json");
//   const Construction quarter_circle = construct(R"({"kind": "nurbs_curve", "degree": 2, "knots": [0, 0, 0, 1, 1, 1],
//                                                     "homogeneous": [[1, 0, 0, 1], [1, 1, 0, 1], [0, 2, 0, 2]]})");
//   const Construction line = construct(R"({"kind": "bezier_curve", "degree": 1, "points": [[0, 0, 0], [1, 2, 0]]})");
//   const LimitSamples samples = cone.surfaces().evaluate({{.face = 0, .u = 0.5, .v = 0.5}}, 1);
//   const CurveSamples points = line.curves().evaluate({{.segment = 0, .t = 0.5}}, 2);
//   cone.write("cone.obj");  // the exact control net
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/patches.h"

namespace sublimit {

/// Classical curves with their control points, which it owns. Segments are the knot spans of all curves, curve by
/// curve. It never changes: any number of threads may share it, and copies share all its data.
class Curves {
 public:
  /// Makes curves of their knots and control points.
  /// @param columns  #points x dimension, with one more column, the weight, if they are homogeneous
  Curves(CurveSet set, Points columns, Coordinates coordinates = Coordinates::plain);

  const CurveSet& set() const;   ///< the curves without points
  const Points& points() const;  ///< control points, with the weight as the last column if they are rational
  bool rational() const;         ///< true if points are homogeneous: (w x, ..., w)
  /// Returns how many curves there are.
  Index num_curves() const { return set().num_curves(); }
  /// Returns how many segments all of them have: one for each span of knots.
  Index num_segments() const { return set().num_segments(); }

  /// Evaluates places, in parallel.
  /// @param derivatives  0, 1 (with normals of plane curves) or 2, per unit of the segment's t
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1], other derivatives
  CurveSamples evaluate(std::span<const CurvePlace> places, int derivatives = 0) const;
  /// Evaluates places that are listed: `evaluate({{.segment = 0, .t = 0.5}}, 1)`.
  CurveSamples evaluate(std::initializer_list<CurvePlace> places, int derivatives = 0) const {
    return evaluate(std::span(places.begin(), places.size()), derivatives);
  }

 private:
  struct Bound;
  std::shared_ptr<const Bound> bound_;
};

/// Curves and surfaces made from recipes. It never changes: any number of threads may share it, and copies share all
/// its data.
class Construction {
 public:
  const std::vector<std::string>& names() const&;  ///< name of each recipe or element, as in messages
  const std::vector<std::string>& notes() const&;  ///< warnings about accepted input
  std::vector<std::string> names() && { return std::as_const(*this).names(); }  ///< a copy, from temporaries
  std::vector<std::string> notes() && { return std::as_const(*this).notes(); }  ///< a copy, from temporaries

  /// Returns all surfaces as one set of patches.
  /// @throws UnsupportedTopology  there are none, or triangular patches besides others
  Patches surfaces() const;
  /// Returns all curves as one set of curves.
  /// @throws UnsupportedTopology  there are none
  Curves curves() const;
  /// Writes the exact control nets as free-form .obj: `bezier`, `bspline`, with `rat` if rational.
  /// @throws UnsupportedTopology  a curve or surface without an exact net, or with one that OBJ cannot hold: the
  ///                              message says which and why
  /// @throws InvalidOption        another extension
  /// @throws IoError              unwritable;  ResourceError  a full disk
  void write(const std::filesystem::path& path) const;

 private:
  friend Construction construct(const std::string& recipe);
  struct Made;
  explicit Construction(std::shared_ptr<const Made> made) : made_(std::move(made)) {}
  std::shared_ptr<const Made> made_;
};

/// Makes the curves and surfaces of a recipe.
/// @param recipe  path of a file, .json or free-form .obj; or the JSON itself, which begins with {
/// @throws FormatError  a recipe that cannot be parsed; the message names recipe and field, and what would be right
/// @throws InvalidMesh  curves that do not meet where they must; the message has the gap
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Construction construct(const std::string& recipe);

}  // namespace sublimit

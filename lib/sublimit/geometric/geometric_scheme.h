// SPDX-License-Identifier: Apache-2.0
#pragma once
// Schemes that are not linear: no masks, no matrix, but a step from data to data and, if it is known, the limit in
// closed form. `Data` is what the scheme refines: a ControlPolygon with tangents for curves, for surfaces a
// CurvatureMesh, or a NormalMesh where the surface is known and there are no steps.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sublimit/base/error.h"
#include "sublimit/core/scheme_options.h"
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// Properties that a geometric scheme is said to have. No result depends on them; each has its law in the tests.
struct GeometricClaims {
  std::optional<int> regular = {};  ///< the limit is G^regular; nothing if that is not claimed
  bool interpolates = false;        ///< old data stay, bitwise
  std::string reproduces;           ///< in words
  std::string limit;                ///< in words
  std::string exponent;             ///< Hoelder exponent of the limit by arc length, in words
};

/// A place on the limit of a segment.
struct SegmentPlace {
  Eigen::Vector3d position;
  Eigen::Vector3d tangent;    ///< of length 1
  Eigen::Vector3d curvature;  ///< derivative of the tangent by length
};
/// The limit of a segment over t in [0, 1]; where pieces meet inside, that of the piece before or behind.
using SegmentCurve = std::function<SegmentPlace(double t, bool before)>;

class PlacedSurface;

template <class Data>
struct GeometricScheme {
  std::string name;
  std::string source;  ///< author, year, title
  /// Data fit for `refine` and `limit`.
  /// @throws InvalidMesh, UnsupportedTopology  what the scheme cannot take, where, and what would be right
  std::function<Data(Data)> checked;
  /// One step, of checked or refined data; empty where the surface is made at once, not by steps.
  std::function<Data(const Data&)> refine;
  /// Data of level `levels`, on the exact limit of checked data; empty where the limit is not known in closed form.
  std::function<Data(const Data&, int levels)> limit = {};
  /// Curves with a known limit: the exact limit of checked data anywhere, of each curve its segments in order.
  std::function<std::vector<std::vector<SegmentCurve>>(const Data&)> segments = {};
  /// Surfaces with a known limit: the exact limit of checked data anywhere.
  std::function<std::shared_ptr<const PlacedSurface>(const Data&)> surface = {};
  /// Notes worth telling about checked data: where the scheme fell back on another rule.
  std::function<std::vector<std::string>(const Data&)> notes;
  GeometricClaims claims;
  std::vector<OptionInfo> options = {};
};
using GeometricCurveScheme = GeometricScheme<ControlPolygon>;

/// Data of level `levels`.
/// @param progress  called before each level with its number, if given
template <class Data>
[[nodiscard]] Data refine(const GeometricScheme<Data>& scheme, const Data& data, int levels,
                          const std::function<void(int)>& progress = {}) {
  if (levels < 0) throw InvalidParameter("levels is " + std::to_string(levels) + "; it must be 0 or more");
  Data result = scheme.checked(data);
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    result = scheme.refine(result);
  }
  return result;
}

}  // namespace sublimit

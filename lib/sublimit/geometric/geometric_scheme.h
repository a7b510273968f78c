// SPDX-License-Identifier: Apache-2.0
#pragma once
// Nonlinear schemes: without masks and matrices, with a step from data to data and, if known, the limit in
// closed form. `Data` is the type that the scheme refines: a ControlPolygon with tangents for curves, a
// CurvatureMesh for surfaces, or a NormalMesh for surfaces that are constructed directly, without steps.
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

/// Claimed properties of a geometric scheme. No result depends on them; tests check each.
struct GeometricClaims {
  std::optional<int> regular = {};  ///< the limit is G^regular; nothing: no claim
  bool interpolates = false;        ///< a step keeps the bits of old data
  std::string reproduces;           ///< shapes that are reproduced, in words
  std::string limit;                ///< description of the limit, in words
  std::string exponent;             ///< Hoelder exponent of the limit by arc length, in words
};

/// A place on the limit of a segment.
struct SegmentPlace {
  Eigen::Vector3d position;
  Eigen::Vector3d tangent;    ///< unit length
  Eigen::Vector3d curvature;  ///< derivative of the tangent by length
};
/// The limit of a segment over t in [0, 1]; where pieces meet inside, of the piece before t if `before`, else
/// behind.
using SegmentCurve = std::function<SegmentPlace(double t, bool before)>;

class PlacedSurface;

/// A nonlinear scheme.
template <class Data>
struct GeometricScheme {
  std::string name;
  std::string source;  ///< author, year, title
  /// Returns data checked for `refine` and `limit`.
  /// @throws InvalidMesh, UnsupportedTopology  unsuitable data; says what, where, and what would be right
  std::function<Data(Data)> checked;
  /// Returns checked or refined data after one step; empty for surfaces that are constructed without steps.
  std::function<Data(const Data&)> refine;
  /// Returns data of a level on the exact limit of checked data; empty if the limit is not known in closed
  /// form.
  std::function<Data(const Data&, int levels)> limit = {};
  /// Curves with a known limit: returns the exact limit of checked data as the segments of each curve, in
  /// order.
  std::function<std::vector<std::vector<SegmentCurve>>(const Data&)> segments = {};
  /// Surfaces with a known limit: returns the exact limit of checked data.
  std::function<std::shared_ptr<const PlacedSurface>(const Data&)> surface = {};
  /// Returns notes about checked data: where the scheme uses a fallback rule.
  std::function<std::vector<std::string>(const Data&)> notes;
  GeometricClaims claims;
  std::vector<OptionInfo> options = {};
};
using GeometricCurveScheme = GeometricScheme<ControlPolygon>;

/// Returns the data of level `levels`.
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

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Joints of the curves of a file: at knots between pieces of a curve, and at ends of curves that meet.
#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/joins/curve_join.h"
#include "sublimit/report/free_form/curve_bezier.h"

namespace sublimit {

struct FreeFormJoint {
  enum class Kind {
    knot,  ///< between pieces of one curve
    ends,  ///< two ends of different curves, or both ends of a closed one
  } kind = Kind::knot;
  std::size_t left = 0, right = 0;                 ///< curves
  bool left_reversed = false;                      ///< the left curve has its start at the joint
  bool right_reversed = false;                     ///< the right curve has its end at the joint
  double left_parameter = 0, right_parameter = 0;  ///< parameters of the curves
  CurveJoin measured;
  std::optional<JoinOrders> exact{};
  /// The greater curvature of both sides, 1/length, to which jumps are relative.
  double greatest_curvature = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::string recipe{};  ///< recipe that requires it; empty: none
};
const char* name(FreeFormJoint::Kind kind);

struct FreeFormJoints {
  std::vector<FreeFormJoint> joints;  ///< knots first, by curves
  std::size_t free_ends = 0;          ///< ends of curves that meet no other end
  std::size_t branches = 0;           ///< points where three or more ends meet, which are not compared
};

/// Finds and measures all joints.
/// @param same  distance up to which ends are one point
/// @param near  ends at larger distances up to this one are compared, as a gap, if they have no other partner
FreeFormJoints free_form_joints(std::span<const CurveBezier> curves, double same, double near);

/// Returns the number of free ends of pairs of curves, in which the end of the first is joined to the start of
/// the second: two for each pair, or none if these two ends are one point.
/// @param same  distance up to which ends are one point
std::size_t free_ends_of_pairs(std::span<const CurveBezier> curves, double same);

/// Measures the joint between the end of one curve and the start of another, whatever their distance.
FreeFormJoint end_to_start(std::span<const CurveBezier> curves, std::size_t left, std::size_t right);

}  // namespace sublimit

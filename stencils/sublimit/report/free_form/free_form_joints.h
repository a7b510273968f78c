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
    ends,  ///< two ends of curves, or both of one: closed
  } kind = Kind::knot;
  std::size_t left = 0, right = 0;                 ///< curves
  bool left_reversed = false;                      ///< the left one ends here with its start
  bool right_reversed = false;                     ///< the right one begins here with its end
  double left_parameter = 0, right_parameter = 0;  ///< parameters of the curves
  CurveJoin measured;
  std::optional<JoinOrders> exact{};
  /// The greater curvature of both, 1/length; what a jump is a part of.
  double greatest_curvature = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::string recipe{};  ///< recipe that requires it; empty: none
};
const char* name(FreeFormJoint::Kind kind);

struct FreeFormJoints {
  std::vector<FreeFormJoint> joints;  ///< knots first, by curves
  std::size_t free_ends = 0;          ///< ends of curves where no other one is
  std::size_t branches = 0;           ///< points where three ends or more meet: not compared
};

/// @param same  ends as near as that are one point
/// @param near  ends beyond `same` and within that are compared where they have no other partner: a gap
FreeFormJoints free_form_joints(std::span<const CurveBezier> curves, double same, double near);

/// Ends of pairs of curves, the end of the first being joined to the start of the second, that are left over: two of
/// each pair, none where these two are one point.
/// @param same  ends as near as that are one point
std::size_t free_ends_of_pairs(std::span<const CurveBezier> curves, double same);

/// The end of one curve with the start of another, wherever they are.
FreeFormJoint end_to_start(std::span<const CurveBezier> curves, std::size_t left, std::size_t right);

}  // namespace sublimit

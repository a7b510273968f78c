// SPDX-License-Identifier: Apache-2.0
#pragma once
// Screw surfaces (helicoids): a curve that rotates about the z axis and rises in proportion,
//
//   S(u,v) = R_z(u) c(v) + u h / (2 pi) e_z,   u in radians
//
// They are no splines. Two stages: each control point P = (X, Y, Z) of the curve gives four, its image on the
// axis O = (0, 0, Z), itself, itself after a quarter turn Q = (-Y, X, Z), and E = O + h / (2 pi) e_z; rows over
// these are N(v) times (1 - cos u - sin u - u, cos u, sin u, u), which sum to N(v).
#include "sublimit/patches/constructions/spline_net.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A screw surface.
class ScrewSurface : public Patch {
 public:
  /// Makes a surface whose faces are the spans of v times equal arcs of u of at most a quarter turn, arcs
  /// fastest.
  /// @param from, to  range of u, radians
  /// @throws InvalidParameter  angles that are not finite or do not ascend, more than 10^5 turns
  ScrewSurface(Knots<double> v, double from, double to);

  /// Returns the control points of the surface from those of the curve: O, P, Q, E for each.
  /// @param pitch  rise per whole turn
  /// @throws InvalidParameter  columns that do not fit the knots
  Points columns(const CurveNet& curve, double pitch) const;

  Index num_points() const override { return 4 * v_.num_points(); }
  FaceCount faces() const override { return {arcs_ * v_.num_faces(), false}; }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;

  /// Parameters are the angle in radians and the parameter of the curve.
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index face) const override;

 private:
  double angle(Index arc, double u) const;

  Knots<double> v_;
  double from_, to_;
  Index arcs_;
};

}  // namespace sublimit

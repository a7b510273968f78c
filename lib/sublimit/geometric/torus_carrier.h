// SPDX-License-Identifier: Apache-2.0
#pragma once
// Carriers of edges: surfaces with the data of both ends, derived from a torus piece that has the data of one.
//
// The surface is written as a height w along the normals of the torus piece. At the near end w and its derivatives of
// first and second order vanish; at the far end they follow from position, normal and shape there. Half way
// they are given by a Hermite rule, in x from 0 to 1 along the edge and a direction y across it, the chord's
// directions in each tangent plane:
//
//   w = (w0 + w1)/2 + 3/20 (w0' - w1') + 1/80 (w0'' + w1'')         w_y  = (w_y0 + w_y1)/2 + 1/8 (w_y0' - w_y1')
//   w' = 9/4 (w1 - w0) - 5/8 (w0' + w1') - 1/16 (w0'' - w1'')       w_y' = 2 (w_y1 - w_y0) - 1/2 (w_y0' + w_y1')
//   w'' = 3/2 (w1' - w0') - 1/4 (w0'' + w1'')                       w_yy = (w_yy0 + w_yy1)/2
//
// The rule is exact for cubic polynomials. So is the one of the quintic in x and cubics in y, 5/32 1/64 | 15/8
// 7/16 1/32 | 3/2 1/4 | 1/8 | 3/2 1/4; but in a plane, on a regular lattice, differences of second derivatives
// from those of a quadratic polynomial then grow, by 1.2 a level: the joint spectral radius of the four maps
// from the data of a triangle to those of its children, modulo quadratics, is 0.30 > 1/4. With the weights
// above it is below 0.195 (in floating point; of the linear rule, not of the scheme). The direction y leads
// from one opposite corner to the other, so that the rule in a plane is affinely invariant: all lattices are
// like the regular one. With y at right angles to the edge the radius would exceed 1/2 for triangles like (0,
// 0), (1, 0), (0, 1).
//
// If the data of both ends lie on the torus piece, w is zero and the carrier is that piece.
#include <optional>

#include "sublimit/geometric/torus_piece.h"

namespace sublimit {

/// The carrier of an edge.
class TorusCarrier {
 public:
  /// Returns the carrier from a torus piece at the near end and the data of the far end.
  /// @param skew  y is the direction of the edge rotated by 90 degrees to the left, plus `skew` times the edge
  /// @return  nothing if the normal of the far end is opposite to that of the torus piece, or the data are not
  ///          finite
  static std::optional<TorusCarrier> make(const TorusPiece& piece, const SurfacePoint& far, double skew = 0);

  /// Returns the squared misfit between the far end's data and the torus piece: the sum of the squares of
  /// height/length, slope, and curvature times length.
  double misfit2() const { return misfit2_; }
  const TorusPiece& piece() const { return piece_; }
  double nearness() const { return nearness_; }  ///< TorusPiece::nearness of the far end

  /// A point of the carrier.
  struct Middle {
    Eigen::Vector3d position, normal;
    Eigen::Matrix3d shape;  ///< as SurfacePoint::shape
    double distance = 0;    ///< distance of the guess from the torus piece
  };
  /// Returns the point of the carrier half way, over the point of the torus piece nearest to `guess`.
  /// @return  nothing if the edge has no direction on the piece
  std::optional<Middle> middle(const Eigen::Vector3d& guess) const;

 private:
  explicit TorusCarrier(const TorusPiece& piece) : piece_(piece) {}

  TorusPiece piece_;
  Eigen::Vector3d chord_ = Eigen::Vector3d::Zero();
  double skew_ = 0, length_ = 0, misfit2_ = 0, nearness_ = 0;
  // Value and derivatives of w at the far end, by x in [0, 1] along the edge and by y across.
  double value_ = 0, along_ = 0, across_ = 0, along_along_ = 0, along_across_ = 0, across_across_ = 0;
};

}  // namespace sublimit

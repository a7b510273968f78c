// SPDX-License-Identifier: Apache-2.0
#pragma once
// A carrier of an edge: a surface with the data of both ends, made of a torus piece that has the data of one.
//
// The surface is written as a height w along the normals of the torus piece. At the near end w and its derivatives of
// first and second order vanish; at the far end P they follow from position, normal and shape there. In the middle of
// the edge, w comes from the quintic polynomial with these values, slopes and second derivatives along the edge, its
// slope across from the cubic polynomial with the values and derivatives across, its second derivative across is the
// mean. If the data of both ends lie on the torus piece, w is zero and the carrier is that piece.
#include <optional>

#include "sublimit/torus_piece.h"

namespace sublimit {

class TorusCarrier {
 public:
  /// @return  nothing if the far end's normal points away from the torus piece's, or if the data are not finite there
  static std::optional<TorusCarrier> make(const TorusPiece& piece, const SurfacePoint& far);

  /// How badly the far end's data fit on the piece: height by length, slope, curvature times length, added in squares.
  double misfit2() const { return misfit2_; }
  const TorusPiece& piece() const { return piece_; }

  struct Middle {
    Eigen::Vector3d position, normal;
    Eigen::Matrix3d shape;  ///< as SurfacePoint::shape
    double distance = 0;    ///< of the guess from the torus piece
  };
  /// The carrier half way, at the torus piece's point nearest to `guess`.
  /// @return  nothing where the edge has no direction on the piece
  std::optional<Middle> middle(const Eigen::Vector3d& guess) const;

 private:
  explicit TorusCarrier(const TorusPiece& piece) : piece_(piece) {}

  TorusPiece piece_;
  TorusPiece::Place far_;
  double length_ = 0, misfit2_ = 0;
  // Of w at the far end by the edge's parameter x in [0, 1], and by the direction across, as long.
  double value_ = 0, along_ = 0, across_ = 0, along_along_ = 0, along_across_ = 0, across_across_ = 0;
};

}  // namespace sublimit

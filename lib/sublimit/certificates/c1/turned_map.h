// SPDX-License-Identifier: Apache-2.0
#pragma once
// Characteristic maps for an interval of sector angles phi. Points are a + i s b with balls a and b and s =
// sin(phi/2), which may tend to zero. With h = cos(phi/2), exp(i phi/2) = h + i s, and products require only
// s^2 = 1 - h^2.
#include <map>
#include <optional>
#include <vector>

#include "sublimit/certificates/c1/map_proof.h"

namespace sublimit {

/// The point a + i s b.
struct TurnedPoint {
  Ball a, b;
};

/// The net of a characteristic map for an interval of angles.
class TurnedMap {
 public:
  /// @param h, lambda    enclosures of cos(phi/2) and of the leading eigenvalue
  /// @param mask         must outlive this
  /// @param labels, net  points of sector 0, given by the unknowns of `real_block`
  TurnedMap(Ball h, Ball lambda, const RegularMask<Algebraic>& mask, const std::vector<SectorLabel>& labels,
            const std::vector<Ball>& net);
  TurnedMap(Ball, Ball, const RegularMask<Algebraic>&&, const std::vector<SectorLabel>&,
            const std::vector<Ball>&) = delete;

  /// Returns the point at a place of the plane around sector 0; nothing if the place has no label, or the mask
  /// reaches too far.
  std::optional<TurnedPoint> at(LatticePoint p);

  /// Returns a lower bound of the Jacobian determinant divided by s, between rings r and D r; nothing unless it
  /// is certainly positive.
  std::optional<Ball> least_jacobian(const RegularPieces& pieces, const BallFunctions& functions, int ring);
  /// True if the outer boundary of the sector certainly lies in the half-plane around the middle of the sector.
  bool winds_once(const RegularPieces& pieces, const BallFunctions& functions, int ring);

 private:
  TurnedPoint product(const TurnedPoint& x, const TurnedPoint& y) const;
  std::optional<MapPiece> piece(const RegularPieces& pieces, const BallFunctions& functions, const PlacedPiece& placed);

  Ball h_, square_, lambda_;
  TurnedPoint turn_, back_;  // rotations by one sector, forwards and backwards
  const RegularMask<Algebraic>& mask_;
  std::map<LatticePoint, TurnedPoint> net_;
};

}  // namespace sublimit

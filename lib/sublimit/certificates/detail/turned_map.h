// SPDX-License-Identifier: Apache-2.0
#pragma once
// The characteristic map where the angle phi of a sector is only known to lie in an interval. Points are a + i s b with
// s = sin(phi/2), which may go to zero; a and b are balls. With h = cos(phi/2), exp(i phi/2) = h + i s, and products
// need s^2 = 1 - h^2 alone.
#include <map>
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/map_proof.h"

namespace sublimit {

/// a + i s b
struct TurnedPoint {
  Ball a, b;
};

class TurnedMap {
 public:
  /// @param mask         which must stay
  /// @param labels, net  of sector 0: the unknowns of `real_block`
  TurnedMap(Ball h, Ball lambda, const RegularMask<Algebraic>& mask, const std::vector<SectorLabel>& labels,
            const std::vector<Ball>& net);
  TurnedMap(Ball, Ball, const RegularMask<Algebraic>&&, const std::vector<SectorLabel>&,
            const std::vector<Ball>&) = delete;

  /// A point of the plane around sector 0. Nothing where it has no label, or the mask reaches too far.
  std::optional<TurnedPoint> at(LatticePoint p);

  /// Below the Jacobian determinant divided by s, between rings r and D r. Nothing where it is not known to be
  /// positive.
  std::optional<Ball> least_jacobian(const RegularPieces& pieces, const BallFunctions& functions, int ring);
  /// The outer boundary of the sector stays in the half-plane around the sector's middle.
  bool winds_once(const RegularPieces& pieces, const BallFunctions& functions, int ring);

 private:
  TurnedPoint product(const TurnedPoint& x, const TurnedPoint& y) const;
  std::optional<MapPiece> piece(const RegularPieces& pieces, const BallFunctions& functions, const PlacedPiece& placed);

  Ball h_, square_, lambda_;
  TurnedPoint turn_, back_;  // by a sector
  const RegularMask<Algebraic>& mask_;
  std::map<LatticePoint, TurnedPoint> net_;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gregory's patches: general Coons patches (coons.h) whose two fields ask for different twists at a corner. There the
// twist is blended by place,
//
//   t(u,v) = (u xu'(0) + v xv'(0)) / (u + v)        at (0,0); u -> 1 - u, v -> 1 - v at the other corners
//
// so that both boundary curves and both cross derivatives are met; S_uv has no limit at the corner. Rows are over the
// net of the patch without twists and, for each corner, its point c and c + xu', c + xv': rational in u and v, linear
// in the data, no spline. Source: Gregory 1974, "Smooth interpolation without twist constraints".
#include <array>

#include "sublimit/patches/constructions/coons.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

class GregoryPatch : public Patch {
 public:
  /// @param net      of the general patch with twists that are right at the corners not blended, 0 at the others
  /// @param blended  by coons_corners
  GregoryPatch(SplineSurface net, const std::array<bool, 4>& blended);

  const std::array<bool, 4>& blended() const { return blended_; }

  /// Those of the net, then c + xu', c + xv' of each corner.
  Index num_points() const override { return net_.num_points() + 8; }
  FaceCount faces() const override { return net_.faces(); }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& sample, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  Place place(const Parameters& parameters) const override { return net_.place(parameters); }
  Parameters parameters(const Place& place) const override { return net_.parameters(place); }
  Lengths lengths(Index face) const override { return net_.lengths(face); }

 private:
  SplineSurface net_;
  std::array<bool, 4> blended_;
};

struct GregoryNet {
  std::shared_ptr<const GregoryPatch> patch;
  Points columns;
};

/// @param tolerance  as general_coons; twists that differ by less are one
/// @throws InvalidParameter, InvalidMesh  as general_coons but for twists
GregoryNet gregory_patch(const CoonsBoundary& curves, const CoonsFields& fields, double tolerance = -1);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gregory patches: general Coons patches (coons.h) whose two fields require different twists at a corner. There
// the twist depends on the place,
//
//   t(u,v) = (u xu'(0) + v xv'(0)) / (u + v)        at (0,0); u -> 1 - u, v -> 1 - v at the other corners
//
// so that boundary curves and cross derivatives are interpolated; S_uv has no limit at the corner. Rows are
// over the net of the patch without twists and, for each corner with point c, over c + xu' and c + xv'. They
// are rational in u and v, and linear in the data; the surface is no spline. Source: Gregory 1974, "Smooth
// interpolation without twist constraints".
#include <array>

#include "sublimit/patches/constructions/coons.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A Gregory patch.
class GregoryPatch : public Patch {
 public:
  /// @param net      general Coons patch with the right twists at corners that are not blended, and 0 at the
  ///                 others
  /// @param blended  whether the twist is blended, for each of coons_corners
  GregoryPatch(SplineSurface net, const std::array<bool, 4>& blended);

  const std::array<bool, 4>& blended() const { return blended_; }

  /// Number of points: those of the net, then c + xu', c + xv' of each corner.
  Index num_points() const override { return net_.num_points() + 8; }
  FaceCount faces() const override { return net_.faces(); }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  Place place(const Parameters& parameters) const override { return net_.place(parameters); }
  Parameters parameters(const Place& place) const override { return net_.parameters(place); }
  Lengths lengths(Index face) const override { return net_.lengths(face); }

 private:
  SplineSurface net_;
  std::array<bool, 4> blended_;
};

/// A Gregory patch with its control columns.
struct GregoryNet {
  std::shared_ptr<const GregoryPatch> patch;
  Points columns;
};

/// Returns the Gregory patch of curves and fields.
/// @param tolerance  see general_coons; twists that differ by less count as equal
/// @throws InvalidParameter, InvalidMesh  see general_coons, except for twists
GregoryNet gregory_patch(const CoonsBoundary& curves, const CoonsFields& fields, double tolerance = -1);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// The polynomial surface through a grid of points (lagrange_basis.h): one face, its rows over all points.
#include "sublimit/patches/constructions/lagrange_basis.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

class LagrangeSurface : public Patch {
 public:
  /// Points are a grid over the nodes, u fastest.
  /// @throws ResourceError  more points than 32-bit indices count
  LagrangeSurface(LagrangeBasis u, LagrangeBasis v);

  Index num_points() const override { return u_.size() * v_.size(); }
  FaceCount faces() const override { return {1, false}; }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& sample, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;

  /// Parameters of the nodes.
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index) const override { return {u_.length(), v_.length()}; }
  /// If `lagrange_to_bezier` has both directions.
  std::optional<BezierRows> bezier(Index face) const override;

 private:
  LagrangeBasis u_, v_;
};

}  // namespace sublimit

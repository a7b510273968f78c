// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial surfaces through a grid of points (lagrange_basis.h): one face, whose rows are over all points.
#include "sublimit/patches/constructions/lagrange_basis.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A tensor-product surface of two Lagrange bases.
class LagrangeSurface : public Patch {
 public:
  /// Points are a grid over the nodes, u fastest.
  /// @throws ResourceError  more points than 32-bit indices count
  LagrangeSurface(LagrangeBasis u, LagrangeBasis v);

  Index num_points() const override { return u_.size() * v_.size(); }
  FaceCount faces() const override { return {1, false}; }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;

  /// Parameters are those of the nodes.
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index) const override { return {u_.length(), v_.length()}; }
  /// Returns the Bezier rows if `lagrange_to_bezier` converts both directions.
  std::optional<BezierRows> bezier(Index face) const override;

 private:
  LagrangeBasis u_, v_;
};

}  // namespace sublimit

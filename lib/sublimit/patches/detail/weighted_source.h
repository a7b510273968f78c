// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rational surfaces with fixed weights as linear sources: such a surface is linear in its points,
//
//   x(f,u,v) = sum_i R_i(f,u,v) P_i     R_i = w_i N_i / sum_j w_j N_j
//
// so that fits and energies, which take a linear source, can use it.
#include "sublimit/patches/patch_set.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// Rational patches with fixed weights.
class WeightedSource : public LinearSource {
 public:
  /// @param patches  rational patches; must outlive this
  /// @param weights  weight of each control point
  /// @throws InvalidParameter     another number of weights, weights that are not finite; a weight of 0 (a
  ///                              direction, not a point), naming the point
  /// @throws UnsupportedTopology  patches over plain columns
  WeightedSource(const PatchSet& patches, Eigen::VectorXd weights);
  WeightedSource(const PatchSet&&, Eigen::VectorXd) = delete;

  Index num_points() const override { return patches_.num_points(); }
  FaceCount faces() const override { return patches_.faces(); }
  FaceLengths lengths(Index face) const override { return patches_.lengths(face); }
  /// Returns rows of R and its derivatives; no rows at a pole, where the status is `pole`.
  LimitStencil stencil(const Place& place, int order = 0) const override;
  /// @param points  #points x 3
  LimitSamples evaluate(const Points& points, std::span<const Place> samples, int order = 0,
                        bool normals = true) const override;

 private:
  const PatchSet& patches_;
  Eigen::VectorXd weights_;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A rational surface whose weights stay as they are is linear in its points,
//
//   x(f,u,v) = sum_i R_i(f,u,v) P_i     R_i = w_i N_i / sum_j w_j N_j
//
// so that fits, energies and whatever else takes a linear source take it.
#include "sublimit/limit/linear_source.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

class WeightedSource : public LinearSource {
 public:
  /// @param patches  rational; they must stay
  /// @param weights  of each control point
  /// @throws InvalidParameter     another number of weights, weights that are not finite; one that is 0, naming the
  ///                              point: it would be a direction
  /// @throws UnsupportedTopology  patches over plain columns
  WeightedSource(const PatchSet& patches, Eigen::VectorXd weights);
  WeightedSource(const PatchSet&&, Eigen::VectorXd) = delete;

  Index num_points() const override { return patches_.num_points(); }
  FaceCount faces() const override { return patches_.faces(); }
  FaceLengths lengths(Index face) const override { return patches_.lengths(face); }
  /// Rows of R and its derivatives. At a pole there are none, and the status is `pole`.
  LimitStencil stencil(const Place& sample, int order = 0) const override;
  /// @param points  #points x 3
  LimitSamples evaluate(const Points& points, std::span<const Place> samples, int order = 0,
                        bool normals = true) const override;

 private:
  const PatchSet& patches_;
  Eigen::VectorXd weights_;
};

}  // namespace sublimit

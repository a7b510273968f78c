// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a patch: what lies in a rectangle of its parameters. Its faces are the parts of the patch's, over the same
// control points.
#include "sublimit/patches/patch.h"

namespace sublimit {

class CutPatch : public Patch {
 public:
  /// @param first, last  opposite corners of the rectangle, of the patch's own parameters, first < last
  /// @throws InvalidParameter  not inside the domain, without area
  CutPatch(std::shared_ptr<const Patch> patch, Eigen::Array2d first, Eigen::Array2d last);

  Index num_points() const override { return patch_->num_points(); }
  FaceCount faces() const override { return {static_cast<Index>(parts_.size()), false}; }
  std::vector<Index> slots(Index face) const override { return patch_->slots(parts_[size_t(face)].face); }
  LimitStatus rows(const Place& sample, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  std::string ends(Index face) const override { return patch_->ends(parts_[size_t(face)].face); }
  bool is_affine() const override { return patch_->is_affine(); }
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index face) const override;
  std::optional<BezierRows> bezier(Index face) const override;
  /// Returns the next level of a part of a B-spline, or of a patch that is refined to one: its net ends at the part's
  /// ends.
  Refined refined() const override;

 private:
  /// A face of the patch, and what is left of it.
  struct Part {
    Index face = 0;
    double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
  };
  Place inner(const Place& sample) const;

  std::shared_ptr<const Patch> patch_;
  Eigen::Array2d first_, last_;
  std::vector<Part> parts_;  ///< by ascending faces
};

}  // namespace sublimit

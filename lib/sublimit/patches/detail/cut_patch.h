// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of a patch in a rectangle of its parameters. Its faces are the patch's faces, cut at the rectangle,
// over the same control points.
#include "sublimit/patches/patch.h"

namespace sublimit {

/// The part of a patch in a rectangle of parameters.
class CutPatch : public Patch {
 public:
  /// @param first, last  opposite corners (u, v) of the rectangle in the patch's parameters, first < last
  /// @throws InvalidParameter  a rectangle that is not inside the domain, or without area
  CutPatch(std::shared_ptr<const Patch> patch, Eigen::Array2d first, Eigen::Array2d last);

  Index num_points() const override { return patch_->num_points(); }
  FaceCount faces() const override { return {static_cast<Index>(parts_.size()), false}; }
  std::vector<Index> slots(Index face) const override { return patch_->slots(parts_[size_t(face)].face); }
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
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
  /// The part of a face in the rectangle, u0 .. u1 times v0 .. v1 of the face.
  struct Part {
    Index face = 0;
    double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
  };
  /// Returns a place of the part as a place of the patch.
  Place inner(const Place& place) const;

  std::shared_ptr<const Patch> patch_;
  Eigen::Array2d first_, last_;
  std::vector<Part> parts_;  ///< by ascending face
};

}  // namespace sublimit

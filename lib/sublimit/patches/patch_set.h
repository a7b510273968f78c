// SPDX-License-Identifier: Apache-2.0
#pragma once
// Several patches as one linear source: their faces and control points one patch after the other.
#include <vector>

#include "sublimit/limit/linear_source.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

class PatchSet : public LinearSource {
 public:
  /// @param coordinates  of the columns of all of them
  /// @throws ResourceError  more control points or faces than 32-bit indices count
  explicit PatchSet(std::vector<SplineSurface> patches, Coordinates coordinates = Coordinates::plain);

  const std::vector<SplineSurface>& patches() const { return patches_; }
  Coordinates coordinates() const { return coordinates_; }
  Index first_face(size_t patch) const { return first_face_[patch]; }
  Index first_point(size_t patch) const { return first_point_[patch]; }

  Index num_points() const override { return first_point_.back(); }
  FaceCount faces() const override { return {first_face_.back(), false}; }
  /// Of rational patches over homogeneous columns.
  LimitStencil stencil(const Sample& sample, int order = 0) const override;
  /// @param columns  #points x 3, or x 4 if they are homogeneous
  LimitSamples evaluate(const Points& columns, std::span<const Sample> samples, int order = 0,
                        bool normals = true) const override;

 private:
  size_t patch_of(Index face) const;

  std::vector<SplineSurface> patches_;
  Coordinates coordinates_;
  std::vector<Index> first_face_, first_point_;  // by patch, and the end
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A tensor product of two bases of segments: Catmull-Rom surfaces, basis matrices, polynomials by their coefficients.
// Control points are a grid, u fastest; a face is a segment times a segment.
#include "sublimit/patches/detail/segment_basis.h"
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A tensor-product surface of two SegmentBasis.
class BasisSurface : public Patch {
 public:
  /// @throws ResourceError  more control points than 32-bit indices count
  BasisSurface(SegmentBasis u, SegmentBasis v);

  Index num_points() const override { return u_.num_points() * v_.num_points(); }
  FaceCount faces() const override { return {u_.num_faces() * v_.num_faces(), false}; }
  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;
  std::string ends(Index face) const override;
  bool is_affine() const override { return u_.is_affine() && v_.is_affine(); }
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  Lengths lengths(Index face) const override;
  std::optional<BezierRows> bezier(Index face) const override;
  /// Returns the net of all Bezier pieces of the surface, as a B-spline of the same surface (not halved).
  /// Neighbouring pieces share control points unless the surface jumps between them.
  Refined refined() const override;

 private:
  SegmentBasis u_, v_;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Evaluation of many places of patches with given control points: every face of a B-spline surface is converted
// to a Bezier piece in space once. Poles and normals at collapsed sides are left to the patches.
#include <array>
#include <memory>
#include <vector>

#include "sublimit/patches/patch_set.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// Bezier pieces of B-spline patches with control points.
class BezierPieces : public BoundSource {
 public:
  /// @param patches  must outlive this; all of them B-splines
  /// @param columns  control columns of the set
  /// @throws InvalidParameter  columns of another size
  BezierPieces(const PatchSet& patches, const Points& columns);
  BezierPieces(const PatchSet&&, const Points&) = delete;

  void evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const override;

  /// Returns the memory of the pieces in numbers of 8 bytes; 0 if a patch is no B-spline.
  static double num_numbers(const PatchSet& patches);

 private:
  struct Piece {
    size_t first = 0;  ///< control columns, 4 numbers each, u fastest
    std::int8_t p = 0, q = 0;
    bool is_positive = true;            ///< true if all weights are positive
    std::array<std::int8_t, 4> smooth;  ///< k of C^k at u = 0, u = 1, v = 0, v = 1; 3 at ends of the patch
    std::array<double, 3> origin;       ///< point that control columns are relative to
    double small = 0;                   ///< length up to which derivatives may be rounding: left to the patch
  };
  /// Evaluates a place into a row of `out`.
  /// @return  false if the patch must evaluate this place
  template <int Degree, int Order>
  bool evaluate(const Piece& piece, const Place& place, bool normals, LimitSamples& out, Eigen::Index row) const;
  template <int Order>
  bool evaluate(const Place& place, bool normals, LimitSamples& out, Eigen::Index row) const;

  const PatchSet& patches_;
  Points columns_;
  std::vector<Points> own_;  // columns of each patch
  std::vector<Piece> pieces_;
  std::vector<double> numbers_;
};

}  // namespace sublimit

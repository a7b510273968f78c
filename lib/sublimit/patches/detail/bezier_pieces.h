// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patches bound to their control points, for many samples: every face of a B-spline surface as a Bezier piece in space,
// made once. What pieces do not know, poles and the normals of collapsed sides, the patches are asked for.
#include <array>
#include <memory>
#include <vector>

#include "sublimit/limit/linear_source.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

class BezierPieces : public BoundSource {
 public:
  /// @param patches  which must stay; all of them B-splines
  /// @param columns  of the set
  /// @throws InvalidParameter  columns of another size
  BezierPieces(const PatchSet& patches, const Points& columns);
  BezierPieces(const PatchSet&&, const Points&) = delete;

  void evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const override;

  /// Numbers that pieces take, of 8 bytes; 0 if a patch is no B-spline.
  static double num_numbers(const PatchSet& patches);

 private:
  struct Piece {
    size_t first = 0;  ///< control columns, 4 numbers each, u fastest
    std::int8_t p = 0, q = 0;
    bool is_positive = true;            ///< all weights
    std::array<std::int8_t, 4> smooth;  ///< k of C^k at u = 0, u = 1, v = 0, v = 1; 3 where there is no other side
    std::array<double, 3> origin;       ///< columns are seen from there
    double small = 0;                   ///< derivatives of this length may be rounding alone: the patch knows
  };
  /// @return  false if the patch has to be asked
  template <int Degree, int Order>
  bool evaluate(const Piece& piece, const Place& sample, bool normals, LimitSamples& out, Eigen::Index row) const;
  template <int Order>
  bool evaluate(const Place& sample, bool normals, LimitSamples& out, Eigen::Index row) const;

  const PatchSet& patches_;
  Points columns_;
  std::vector<Points> own_;  // columns of each patch
  std::vector<Piece> pieces_;
  std::vector<double> numbers_;
};

}  // namespace sublimit

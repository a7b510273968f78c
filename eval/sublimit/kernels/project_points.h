// SPDX-License-Identifier: Apache-2.0
#pragma once
// The end of a rational evaluation: from homogeneous columns (w x, w) and their derivatives to points and theirs.
#include "sublimit/kernels/apply_patches.h"

namespace sublimit::kernels {

/// Points that lie one after the other. Quantities follow each other as rows of a table do: position, u, v, uu, uv, vv.
template <class Real>
struct Projection {
  /// Channel c of quantity q of point i is number (q * (channels + 1) + c) * plane + i; channel `channels` is the
  /// weight. As many numbers as registers hold may be read after the last one, and may be anything.
  const Real* values = nullptr;
  std::int64_t plane = 0;
  std::int64_t count = 0;
  int channels = 3;  ///< of results
  /// Where a weight's magnitude is not larger than this, all results are zero.
  Real least_weight = 0;
  /// Of the first point; null: not wanted. A derivative needs the quantities of lower order in `values`.
  Real* results[6] = {};
  TangentFrames<Real> frames = {};  ///< of 3 channels
  Strides out = {};
};

/// The quotient rule: x = A/w, x_u = (A_u - w_u x)/w, x_uv = (A_uv - w_u x_v - w_v x_u - w_uv x)/w, ...
/// @param contract  as of `apply_patches`
void project_points(const Projection<float>& projection, bool contract);
void project_points(const Projection<double>& projection, bool contract);

}  // namespace sublimit::kernels

// SPDX-License-Identifier: Apache-2.0
#pragma once
// The last step of a rational evaluation: points and derivatives from homogeneous columns (w x, w) and their
// derivatives.
#include "sublimit/eval/kernels/apply_patches.h"

namespace sublimit::kernels {

/// Consecutive points. Quantities are in the order position, u, v, uu, uv, vv.
template <class Real>
struct Projection {
  /// Channel c of quantity q of point i is number (q * (channels + 1) + c) * plane + i; channel `channels` is the
  /// weight. As many numbers as registers hold may be read after the last one, and may be anything.
  const Real* values = nullptr;
  std::int64_t plane = 0;
  std::int64_t count = 0;
  int channels = 3;  ///< channels of results
  /// Largest magnitude of a weight that counts as zero: all results are zero there.
  Real least_weight = 0;
  /// Results of the first point; null: not wanted. A derivative needs the quantities of lower order in `values`.
  Real* results[6] = {};
  TangentFrames<Real> frames = {};  ///< with 3 channels
  Strides out = {};
};

/// Applies the quotient rule: x = A/w, x_u = (A_u - w_u x)/w, x_uv = (A_uv - w_u x_v - w_v x_u - w_uv x)/w, ...
/// @param contract  as in `apply_patches`
void project_points(const Projection<float>& projection, bool contract);
void project_points(const Projection<double>& projection, bool contract);

}  // namespace sublimit::kernels

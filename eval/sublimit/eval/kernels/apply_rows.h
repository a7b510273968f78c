// SPDX-License-Identifier: Apache-2.0
#pragma once
// Inner loop of sparse rows times points, with x y z in one register.
#include <cstdint>

#include "sublimit/eval/kernels/apply_patches.h"

namespace sublimit::kernels {

/// Rows of a sparse matrix, and the points that they are applied to.
template <class Real>
struct Rows {
  const std::int64_t* offsets = nullptr;  ///< `num_rows` + 1
  const std::int32_t* columns = nullptr;  ///< column of entry 0 of `offsets`; `weights` likewise
  const Real* weights = nullptr;
  std::int64_t num_rows = 0;
  const Real* points = nullptr;
  std::int64_t num_points = 0;
  Strides in;
  Real* result = nullptr;
  Strides out;
  int channels = 3;
};

/// Makes the points of rows.
/// @param contract  as in `apply_patches`
void apply_rows(const Rows<float>& rows, bool contract);
void apply_rows(const Rows<double>& rows, bool contract);

}  // namespace sublimit::kernels

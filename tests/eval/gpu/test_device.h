// SPDX-License-Identifier: Apache-2.0
#pragma once
// The device that tests run on: the first one, or the one that SUBLIMIT_TEST_GPU numbers.
#include <cstdlib>
#include <span>

#include "sublimit/eval/gpu/gpu_device.h"
#include "sublimit/eval/pattern_evaluator.h"

namespace sublimit::testing {

inline GpuDevice test_device() {
  static const GpuDevice device([] {
    const char* const number = std::getenv("SUBLIMIT_TEST_GPU");
    return number ? std::atoi(number) : 0;
  }());
  return device;
}

/// What the scalar kernel makes; of GPUs, which multiply and add in one rounding, what it makes if it does so too. Rows
/// of hundreds of terms differ by more than two roundings otherwise, in either direction from the truth.
inline void apply_as_device(const GpuDevice& device, const PatternTable<float>& table, std::span<const float> points,
                            int channels, std::span<float> result) {
  if (device.info().kind == GpuKind::cpu)
    table.apply(points, channels, result);
  else
    PatternEvaluator<float>(table).apply(points, channels, result);
}

}  // namespace sublimit::testing

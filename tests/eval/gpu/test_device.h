// SPDX-License-Identifier: Apache-2.0
#pragma once
// The device for tests: the first one, or the one whose number is in the environment variable
// SUBLIMIT_TEST_GPU.
#include <cstdlib>
#include <span>

#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/gpu/gpu_device.h"

namespace sublimit::testing {

inline GpuDevice test_device() {
  static const GpuDevice device([] {
    const char* const number = std::getenv("SUBLIMIT_TEST_GPU");
    return number ? std::atoi(number) : 0;
  }());
  return device;
}

/// Applies a table by the scalar kernel; if the device is a GPU, with fused multiplication and addition as on
/// GPUs. Otherwise rows of hundreds of terms would differ by more than two roundings.
inline void apply_as_device(const GpuDevice& device, const PatternTable<float>& table, std::span<const float> points,
                            int channels, std::span<float> result) {
  if (device.info().kind == GpuKind::cpu)
    table.apply(points, channels, result);
  else
    PatternEvaluator<float>(table).apply(points, channels, result);
}

}  // namespace sublimit::testing

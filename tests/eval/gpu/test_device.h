// SPDX-License-Identifier: Apache-2.0
#pragma once
// The device that tests run on: the first one, or the one that SUBLIMIT_TEST_GPU numbers.
#include <cstdlib>

#include "sublimit/gpu/gpu_device.h"

namespace sublimit::testing {

inline GpuDevice test_device() {
  static const GpuDevice device([] {
    const char* const number = std::getenv("SUBLIMIT_TEST_GPU");
    return number ? std::atoi(number) : 0;
  }());
  return device;
}

}  // namespace sublimit::testing

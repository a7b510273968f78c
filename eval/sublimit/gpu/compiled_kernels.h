// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kernels as they were compiled with the library.
#include <cstdint>
#include <span>

#include "sublimit/gpu/driver.h"

namespace sublimit::gpu {

/// SPIR-V; numbers of a variant are its specialisation constants 0 to 3.
std::span<const std::uint32_t> spirv_of(Kernel kernel, bool half);

}  // namespace sublimit::gpu

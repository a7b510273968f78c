// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kernels that were compiled with the library.
#include <cstdint>
#include <span>
#include <string>

#include "sublimit/eval/gpu/detail/driver.h"

namespace sublimit::gpu {

/// Returns the SPIR-V of a kernel; the numbers of a variant are its specialisation constants 0 to 3.
std::span<const std::uint32_t> spirv_of(Kernel kernel, bool half);

/// Returns the PTX of a module with a variant; null: this build has none.
const char* ptx_of(const Variant& variant);
/// Returns the name of a variant's function in its module.
std::string name_in_ptx(const Variant& variant);

}  // namespace sublimit::gpu

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kernels as they were compiled with the library.
#include <cstdint>
#include <span>
#include <string>

#include "sublimit/gpu/driver.h"

namespace sublimit::gpu {

/// SPIR-V; numbers of a variant are its specialisation constants 0 to 3.
std::span<const std::uint32_t> spirv_of(Kernel kernel, bool half);

/// PTX of a variant and others, and the name of its function there; null: this build has none.
const char* ptx_of(const Variant& variant);
std::string name_in_ptx(const Variant& variant);

}  // namespace sublimit::gpu

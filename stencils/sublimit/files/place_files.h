// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a surface as a CSV that `bake --at` and `sample --at` read.
#include <filesystem>
#include <span>

#include "sublimit/limit/address.h"

namespace sublimit {

/// Writes the header `face,u,v` and a row for each place, in order; numbers read back to the same bits.
/// @throws IoError;  ResourceError  a full disk
void write_places(const std::filesystem::path& path, std::span<const Sample> places);

}  // namespace sublimit

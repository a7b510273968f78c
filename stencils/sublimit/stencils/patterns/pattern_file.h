// SPDX-License-Identifier: Apache-2.0
#pragma once
// The dictionary of patterns as a safetensors file, so that later meshes can use patterns that earlier ones
// needed.
#include <filesystem>

#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Writes a dictionary. The file appears whole or not at all; equal patterns in equal order give equal bytes.
/// @throws IoError  unwritable;  ResourceError  a full disk
void save_patterns(const std::filesystem::path& path, const Patterns& patterns);

/// Adds the patterns of a file to a dictionary.
/// @throws IoError      missing, unreadable
/// @throws FormatError  not a dictionary, a broken one, or one for other masks (another scheme, other options)
void load_patterns(const std::filesystem::path& path, Patterns& patterns);

/// Returns a hash that is equal for schemes with equal masks. It is computed from the refinement of a mesh that
/// reaches all rules, in single precision.
std::uint64_t mask_hash(const Scheme<double>& scheme);

}  // namespace sublimit

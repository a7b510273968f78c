// SPDX-License-Identifier: Apache-2.0
#pragma once
// The dictionary of patterns as a file, in the layout of safetensors: what one mesh taught is there for the next one.
#include <filesystem>

#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Appears whole or not at all; the same bytes for the same patterns, met in the same order.
/// @throws IoError  unwritable;  ResourceError  a full disk
void save_patterns(const std::filesystem::path& path, const Patterns& patterns);

/// Adds what a file has.
/// @throws IoError      missing, unreadable
/// @throws FormatError  no dictionary, a broken one, or one of other masks: another scheme, other options
void load_patterns(const std::filesystem::path& path, Patterns& patterns);

/// 64 bits of what a scheme does to a mesh with everything in it, in single precision: the same for the same masks.
std::uint64_t mask_hash(const Scheme<double>& scheme);

}  // namespace sublimit

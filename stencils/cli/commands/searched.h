// SPDX-License-Identifier: Apache-2.0
#pragma once
// The surface that `closest` and `intersect` search: the limit of a mesh, or the free-form patches of a file,
// which need no scheme.
#include <functional>

#include "sublimit/parts/parted_surface.h"
#include "support/source.h"

namespace sublimit::cli {

/// Reads the surface and calls search(surface). Errors name the file.
/// @param source  a mesh or patches
void with_searched_surface(const Source& source, Progress& progress,
                           const std::function<void(const PartedSurface&)>& search);

}  // namespace sublimit::cli

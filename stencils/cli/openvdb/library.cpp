// SPDX-License-Identifier: Apache-2.0
#include <type_traits>

#include "../support/part_version.h"
#include "entry.h"
#include "sublimit/implicit/polygonize/polygonize.h"

extern "C" void sublimit_polygonize(const sublimit::FieldGrid& grid, sublimit::Mesh& mesh) {
  mesh = sublimit::polygonize(grid);
}

static_assert(std::is_same_v<decltype(sublimit_polygonize), sublimit::cli::PolygonizeEntry>);

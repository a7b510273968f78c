// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program that needs OpenVDB, as a library that is loaded when it is wanted: the loader looks up the
// 70000 symbols of OpenVDB and of what it needs, which takes longer than most commands do.
#include "sublimit/implicit/detail/field_grid.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::cli {

constexpr const char* openvdb_library = "libsublimit_openvdb.so";
constexpr const char* polygonize_entry = "sublimit_polygonize";
/// `polygonize`, by a function that has a C name.
using PolygonizeEntry = void(const FieldGrid& grid, Mesh& mesh);

}  // namespace sublimit::cli

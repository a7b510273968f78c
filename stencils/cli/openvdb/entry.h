// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program that needs OpenVDB: a library that is loaded on first use, since resolving the 70000
// symbols of OpenVDB and its dependencies takes longer than most commands.
#include "sublimit/implicit/detail/field_grid.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit::cli {

constexpr const char* openvdb_library = "libsublimit_openvdb.so";
constexpr const char* polygonize_entry = "sublimit_polygonize";
/// Type of the function `polygonize_entry`, which sets `mesh` to the result of `polygonize`.
using PolygonizeEntry = void(const FieldGrid& grid, Mesh& mesh);

}  // namespace sublimit::cli

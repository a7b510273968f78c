// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files with query points, and with the points of a surface that are nearest to them:
//
//   in    .csv, with the header x,y,z or none; .npy, n x 3; the vertices of an .obj, .ply, .off or .stl
//   out   [point,]face,u,v,x,y,z,nx,ny,nz,distance,lower,status
#include <filesystem>

#include "sublimit/search/closest_point.h"

namespace sublimit {

/// Reads all points of a file.
/// @throws FormatError  another extension or shape, rows that are no points, with file:line;  IoError
/// @throws InvalidMesh  numbers that are not finite
Points read_query_points(const std::filesystem::path& path);

/// Writes a row for each point found, in order. The file appears whole or not at all. `lower` is a lower bound
/// of the distance to the surface. Fields of values that do not exist are empty.
/// @param with_query  true: the first column has the number of the query point
void write_closest_points(const std::filesystem::path& path, const ClosestPoints& found, bool with_query);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points whose nearest points on a surface are asked for, and what was found:
//
//   in    .csv, with the header x,y,z or none; .npy, n x 3; the vertices of an .obj, .ply or .off
//   out   [point,]face,u,v,x,y,z,nx,ny,nz,distance,lower,status
#include <filesystem>

#include "sublimit/search/closest_point.h"

namespace sublimit {

/// Reads all points of a file.
/// @throws FormatError  another extension or shape, rows that are no points, with file:line;  IoError
/// @throws InvalidMesh  numbers that are not finite
Points read_query_points(const std::filesystem::path& path);

/// A row for each point found, in order; the file appears whole or not at all. `lower` is a distance that the surface
/// is not nearer than. What does not exist is an empty field.
/// @param with_query  a first column that numbers the points asked for
void write_closest_points(const std::filesystem::path& path, const ClosestPoints& found, bool with_query);

}  // namespace sublimit

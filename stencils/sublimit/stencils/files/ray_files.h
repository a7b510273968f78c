// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files with rays, and with their hits on a surface:
//
//   in    ox,oy,oz,dx,dy,dz[,tmin,tmax]
//   out   ray,t,face,u,v,x,y,z,nx,ny,nz,status
#include <filesystem>
#include <vector>

#include "sublimit/search/intersect.h"

namespace sublimit {

/// Reads all rays of a file. Without tmin and tmax, or with empty fields, they go from 0 to infinity.
/// @throws FormatError  another header, rows that are no rays, with file:line: not finite, no direction, tmin above
/// tmax
/// @throws IoError      missing, unreadable
std::vector<Ray> read_rays(const std::filesystem::path& path);

/// Writes a row for each hit, ordered by ray and t, with its word (`RayHits::word`) as status. The file appears
/// whole or not at all. Fields of values that do not exist are empty.
void write_ray_hits(const std::filesystem::path& path, const RayHits& hits);

}  // namespace sublimit

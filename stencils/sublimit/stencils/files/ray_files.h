// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rays, and where they hit a surface:
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

/// A row for each hit, by ray and by rising t, with its word as status (`RayHits::word`); the file appears whole or not
/// at all. What does not exist is an empty field.
void write_ray_hits(const std::filesystem::path& path, const RayHits& hits);

}  // namespace sublimit

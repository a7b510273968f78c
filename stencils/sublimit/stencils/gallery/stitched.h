// SPDX-License-Identifier: Apache-2.0
#pragma once
// Two B-spline surfaces with unequal knots, stitched into one mesh with knot intervals around a vertex of valence 3.
#include <functional>
#include <string>

#include "sublimit/mesh/mesh.h"
#include "sublimit/stencils/gallery/gallery_part.h"

namespace sublimit::gallery {

/// Name of the scheme of the mesh.
inline constexpr const char* stitched_scheme = "catmull-clark-intervals";

/// Returns the mesh: a lid, and a wall along two of its sides.
Mesh stitched_mesh();

/// Returns a row for each surface, how far the limit is from it, and the files "stitched.svg", "stitched.obj",
/// "stitched.html".
/// @param report  makes the page of a report on a mesh and a scheme's name. If not given, there is no page
GalleryPart stitched_pictures(const std::function<std::string(const Mesh&, const std::string&)>& report);

}  // namespace sublimit::gallery

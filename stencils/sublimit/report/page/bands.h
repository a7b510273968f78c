// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cutting a surface along level lines of a value, so that each band between two lines can have its own colour.
#include <vector>

#include "sublimit/report/page/json.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {

/// Returns the parts of a mesh by value: band i has thresholds[i - 1] <= value < thresholds[i]. Positions and
/// vertex normals of new points are interpolated along edges, equally from both sides.
/// @param values  one per vertex; faces with a value that is not finite are left out
/// @param parts   number of parts, if bands take turns: band i is in part i % parts; 0: a part for each
std::vector<PictureMesh> bands(const PictureMesh& mesh, const std::vector<double>& values,
                               const std::vector<double>& thresholds, std::size_t parts = 0);

/// Returns the mesh of {"positions", "faces", "normals"}; empty if it has no faces. Faces with invalid indices
/// are left out.
PictureMesh mesh_of(const Json& surface);

}  // namespace sublimit::page

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A surface cut along the level lines of a value, so that what lies between two lines can have a colour of its own.
#include <vector>

#include "sublimit/report/page/json.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {

/// The parts of a mesh by value: part i has thresholds[i - 1] <= value < thresholds[i]; positions and vertex normals of
/// new points are means along edges, the same from both sides.
/// @param values  one per vertex; faces with a value that is not finite are left out
std::vector<PictureMesh> bands(const PictureMesh& mesh, const std::vector<double>& values,
                               const std::vector<double>& thresholds);

/// Several meshes as one, of the colour of the first.
PictureMesh joined(const std::vector<PictureMesh>& meshes);

/// {"positions", "faces", "normals"} as a picture; empty if it has no face. Faces with indices outside are left out.
PictureMesh mesh_of(const Json& surface);

}  // namespace sublimit::page

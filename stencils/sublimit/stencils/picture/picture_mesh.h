// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels and limits as meshes for pictures.
#include "sublimit/io/write_mesh.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit {

/// Returns a level with its edges, and its creases by sharpness.
PictureMesh wire_picture(const Level& level, const Points& points);

/// Returns a surface with normals per corner, as `limit_mesh` makes it.
PictureMesh surface_picture(const Mesh& surface);

}  // namespace sublimit

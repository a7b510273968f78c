// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels and limits as what pictures show.
#include "sublimit/io/write_mesh.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit {

/// A level with its wire and its creases by sharpness.
PictureMesh wire_picture(const Level& level, const Points& points);

/// A surface with normals per corner, as `limit_mesh` makes it.
PictureMesh surface_picture(const Mesh& surface);

}  // namespace sublimit

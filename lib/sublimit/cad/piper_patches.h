// SPDX-License-Identifier: Apache-2.0
#pragma once
// Piper's surfaces as patches: three quartic Bezier triangles for each triangle of the mesh.
#include "sublimit/cad/clamped_patches.h"
#include "sublimit/geometric/normal_mesh.h"

namespace sublimit {

/// Returns the patches.
/// @param mesh   checked mesh
/// @param name   name of all patches
/// @param place  place of the mesh, for messages
std::vector<NamedPatch> piper_patches(const NormalMesh& mesh, const std::string& name, const std::string& place);

}  // namespace sublimit

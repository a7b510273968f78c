// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles near a limit surface on their way to a file.
#include <vector>

#include "sublimit/files/split_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Points and triangles; vertex i is place i. `face_ids` are faces of the control mesh.
MeshOutput tessellation_mesh(const Tessellation& made, const LimitMap& surface, bool face_ids);

/// Limit normals of each face's own side at its corners.
/// @param complete  corners that have none get that of their triangle
void add_normals(MeshOutput& out, const Tessellation& made, const LimitMap& surface, const Points& control,
                 bool complete);

/// Places of the vertices of a mesh that was split: the tessellation's own, but on creases that of each side in its own
/// face, where its normal is.
std::vector<Sample> places_of(const SplitMesh& split, const Tessellation& made);

/// Values of a channel at the corners: its own limit at the same places.
/// @param scheme  of the mesh
void add_channel(MeshOutput& out, const Tessellation& made, const Scheme<double>& scheme,
                 FaceVaryingInterpolation interpolation, const ControlMesh::FaceVarying& given, const Level& control);

}  // namespace sublimit

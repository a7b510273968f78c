// SPDX-License-Identifier: Apache-2.0
#pragma once
// Output meshes of tessellations.
#include <vector>

#include "sublimit/io/write_mesh.h"
#include "sublimit/primvar/face_varying.h"
#include "sublimit/io/detail/split_mesh.h"
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Returns the mesh of points and triangles; vertex i is place i.
Mesh tessellation_mesh(const Tessellation& made);
/// Gives triangles the names and values of the faces that they lie on, and points the values of the limit there.
void carry_attributes(const Scheme<double>& scheme, const Mesh& control, const LimitMap& surface,
                      const Tessellation& made, Mesh& out);
/// Returns the mesh with the face of the control mesh that each triangle lies on, as `face_ids`.
Mesh tessellation_mesh(const Tessellation& made, const Addresses& addresses);

/// Returns the places of the corners of triangles, each in the face of its triangle.
std::vector<Place> corner_places(const Tessellation& made);
/// Adds normals at the corners of triangles; at sharp edges they belong to the side of the triangle.
/// @param normals   those at `corner_places`; zero where the surface has none
/// @param complete  true: corners without a normal get that of their triangle
void add_normals(Mesh& out, const Tessellation& made, Points normals, bool complete);

/// Returns the places of the vertices of a split mesh: those of the tessellation, but on creases the place of each side
/// in the face of its normal.
std::vector<Place> places_of(const SplitMesh& split, const Tessellation& made);

/// Adds the values of a channel at the corners: the limit of the channel at their places.
/// @param scheme  scheme of the mesh
void add_channel(Mesh& out, const Tessellation& made, const Scheme<double>& scheme,
                 FaceVaryingInterpolation interpolation, const Mesh::FaceVarying& given, const Level& control);

}  // namespace sublimit

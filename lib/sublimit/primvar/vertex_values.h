// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values at vertices, such as colours, on refined meshes and on limits, by the rule of the mesh (`Mesh::attributes`):
// refined as positions are, or linearly.
#include <vector>

#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Returns the values of a mesh at the vertices of a level, #vertices x #values; no columns if they are dropped.
/// @param levels  level 0 to that level, of this mesh
/// @throws InvalidOption  linear values, and the scheme's split does not keep vertices and edges
/// @throws InvalidMesh    values of some of the vertices alone
Points refined_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<Level>& levels);
/// Returns the same at level `levels`, for a mesh whose levels are not there.
Points refined_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, int levels);

/// Returns the values at places of the limit.
/// @param surface  the limit of the mesh's own rule
Points limit_vertex_values(const Scheme<double>& scheme, const Mesh& mesh, const LimitMap& surface,
                           std::span<const Place> places);

/// Gives a mesh of the last level's faces, or of those that are no holes, all that the mesh of level 0 carries.
/// @param values  at its vertices, as from `refined_vertex_values`
void carry_attributes(const Mesh& control, const std::vector<Level>& levels, const Points& values, Mesh& out);

}  // namespace sublimit

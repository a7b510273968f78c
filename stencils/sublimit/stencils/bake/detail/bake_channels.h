// SPDX-License-Identifier: Apache-2.0
#pragma once
// Texture coordinates, remaining tags and the order of refinement, for tables of levels that store them.
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit {

/// Returns the interpolation for a request: its own, else that of the mesh, else `all`.
FaceVaryingInterpolation interpolation_of(const BakeRequest& request, const Mesh& mesh);

/// Returns an estimate of the memory for `add_channels` in bytes: it refines the mesh, and each channel as a
/// mesh.
double predicted_channel_bytes(const Scheme<double>& scheme, const Topology& control, const Mesh& mesh,
                               const BakeRequest& request);

/// Adds the channels, tags and order that a request asks for to a table of a level or its limit.
/// @param control  level 0 of the mesh
/// @param turn     for tables by patterns: for each face with a lattice, the corner where the lattice starts
/// @throws UnsupportedTopology, InvalidOption  a channel that the scheme cannot refine; see primvar/face_varying.h
/// @throws ResourceError  the refined mesh does not fit into memory
void add_channels(const Scheme<double>& scheme, const Mesh& mesh, const Level& control, const BakeRequest& request,
                  const SubdivisionOptions& options, std::span<const std::int8_t> turn, BakedTable<double>& table);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Texture coordinates, remaining tags and the order of refinement of tables of levels, if they were asked for.
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit {

/// The interpolation that a request asks for: its own, else that of the mesh, else all.
FaceVaryingInterpolation interpolation_of(const BakeRequest& request, const Mesh& mesh);

/// Bytes of memory that this takes, about: the mesh is refined, and each channel as a mesh of its own.
double predicted_channel_bytes(const Scheme<double>& scheme, const Topology& control, const Mesh& mesh,
                               const BakeRequest& request);

/// Adds what `request` asks for to a table of a level or its limit.
/// @param control  level 0 of the mesh
/// @param turn     of a table by patterns: of each face with a lattice, its corner that is the lattice's first one
/// @throws UnsupportedTopology, InvalidOption  a channel that the scheme cannot refine; see primvar/face_varying.h
/// @throws ResourceError  the mesh, refined, does not fit into memory
void add_channels(const Scheme<double>& scheme, const Mesh& mesh, const Level& control, const BakeRequest& request,
                  const SubdivisionOptions& options, std::span<const std::int8_t> turn, BakedTable<double>& table);

}  // namespace sublimit

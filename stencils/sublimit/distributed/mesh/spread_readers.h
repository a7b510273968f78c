// SPDX-License-Identifier: Apache-2.0
#pragma once
// What reads the kinds of files for `read_spread_mesh`, each rank its own bytes. Files are mapped: what a rank does not
// look at it does not have. All ranks call; errors are on all of them.
#include <cstddef>
#include <span>
#include <string_view>

#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

/// Lines of an .obj that begin in a rank's bytes.
SpreadMesh read_obj_parts(const Ranks& ranks, std::string_view text, const std::string& name);
/// Rows of a binary .ply.
SpreadMesh read_ply_parts(const Ranks& ranks, std::string_view bytes, const std::string& name);
/// Tensors of a .safetensors:
///
///   positions         F64 or F32  #vertices x 3
///   face_vertices     I64 or I32  #faces x corners, or one after the other
///   face_sizes        I64 or I32  #faces, in the latter case
///   creases, corners  I64 or I32  #creases x 2, #corners: vertices
///   crease_sharpness, corner_sharpness  F64 or F32
///   holes             I64 or I32  faces
SpreadMesh read_tensor_parts(const Ranks& ranks, std::span<const std::byte> bytes, const std::string& name);

/// That a mesh, and what is known of its vertices and faces, has room, before any of it is read.
/// @throws ResourceError  of this rank
void check_room(const Ranks& ranks, double faces, const std::string& name);

/// A part's tags, their numbers after those of the ranks before.
void take_tags(const Ranks& ranks, const Mesh& from, SpreadMesh& mesh);

}  // namespace sublimit

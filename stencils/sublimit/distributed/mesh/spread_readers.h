// SPDX-License-Identifier: Apache-2.0
#pragma once
// Readers of the kinds of files for `read_spread_mesh`. Each rank parses its own part of the file. Files are
// mapped, so that parts that a rank does not read take none of its memory. Collective: all ranks call, and
// errors are thrown on all.
#include <cstddef>
#include <span>
#include <string_view>

#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

/// Reads an .obj: each rank the lines that begin in its share of the bytes.
SpreadMesh read_obj_parts(const Ranks& ranks, std::string_view text, const std::string& name);
/// Reads a binary .ply: each rank a share of the rows.
SpreadMesh read_ply_parts(const Ranks& ranks, std::string_view bytes, const std::string& name);
/// Reads a .safetensors with the tensors
///
///   positions         F64 or F32  #vertices x 3
///   face_vertices     I64 or I32  #faces x corners, or one after the other
///   face_sizes        I64 or I32  #faces, in the latter case
///   creases, corners  I64 or I32  #creases x 2, #corners: vertices
///   crease_sharpness, corner_sharpness  F64 or F32
///   holes             I64 or I32  faces
SpreadMesh read_tensor_parts(const Ranks& ranks, std::span<const std::byte> bytes, const std::string& name);

/// Checks that a mesh of so many faces, with its incidence, fits into the memory of this machine, before it is
/// read.
/// @throws ResourceError  on this rank
void check_room(const Ranks& ranks, double faces, const std::string& name);

/// Adds the tags, rules and warnings that this rank read to a mesh. Creases and corners are numbered after
/// those of the ranks before. Collective: all ranks call.
void take_tags(const Ranks& ranks, const Mesh& from, SpreadMesh& mesh);

}  // namespace sublimit

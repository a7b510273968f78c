// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of places on a surface: a CSV for `bake --at` and `sample --at`, or a .ply for `bake --tessellation`,
// which also has the triangles between places. Its vertices have the properties place_face, place_u and
// place_v.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sublimit/io/write_mesh.h"
#include "sublimit/source/address.h"

namespace sublimit {

/// Writes the header `face,u,v` and a row for each place, in order; numbers read back to the same bits.
/// @throws IoError;  ResourceError  a full disk
void write_places(const std::filesystem::path& path, std::span<const Place> places);

/// Adds places to the vertices of a mesh.
void add_places(Mesh& mesh, std::span<const Place> places);

/// Faces between places, as sizes and corners.
struct PlacedFaces {
  std::vector<Place> places;
  std::vector<Index> face_sizes, face_vertices;
};
/// Reads places and the faces between them from a .ply.
/// @throws InvalidOption  another extension than .ply
/// @throws FormatError    vertices without places, a face that is not a whole number; and as `read_ply`
PlacedFaces read_placed_faces(const std::filesystem::path& path);
/// Checks that places are on the faces of a surface.
/// @throws FormatError  a place that is not; the message has file and vertex
void check_places(const PlacedFaces& read, FaceCount faces, const std::string& name);

}  // namespace sublimit

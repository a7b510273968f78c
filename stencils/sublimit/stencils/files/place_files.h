// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a surface: as a CSV that `bake --at` and `sample --at` read, or with the triangles between them in a .ply
// that `bake --tessellation` reads, as the properties place_face, place_u and place_v of its vertices.
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
/// @throws InvalidOption  another extension than .ply
/// @throws FormatError    vertices without places, a face that is not a whole number; and as `read_ply`
PlacedFaces read_placed_faces(const std::filesystem::path& path);
/// @throws FormatError  a place that is not on these faces, with file and vertex
void check_places(const PlacedFaces& read, FaceCount faces, const std::string& name);

}  // namespace sublimit

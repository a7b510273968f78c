// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/place_files.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/stencils/files/sample_files.h"
#include "sublimit/stencils/formats/csv_fields.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/row_file.h"

namespace sublimit {
namespace {

// Not u and v, which readers take for texture coordinates.
const std::array<std::string, 3> properties{"place_face", "place_u", "place_v"};

}  // namespace

void write_places(const std::filesystem::path& path, std::span<const Place> places) {
  constexpr std::int64_t rows_per_block = 4096;
  RowFile file(path, "face,u,v\n");
  file.rows(std::ssize(places), rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (const Place& s : places.subspan(size_t(begin), size_t(end - begin))) {
      append_place(text, s);
      text += '\n';
    }
  });
  file.commit();
}

void add_places(Mesh& mesh, std::span<const Place> places) {
  Mesh::Values face{properties[0], {}, ValueType::int32}, u{properties[1]}, v{properties[2]};
  for (const Place& s : places) {
    face.values.push_back(s.face);
    u.values.push_back(s.u);
    v.values.push_back(s.v);
  }
  for (Mesh::Values* values : {&face, &u, &v}) mesh.vertex_values.push_back(std::move(*values));
}

PlacedFaces read_placed_faces(const std::filesystem::path& path) {
  if (!all_formats().reads(path, contents::vertex_values))
    throw InvalidOption(path.string() + ": triangles with places are read from a " +
                        all_formats().readers_in_words({contents::vertex_values}, "or") +
                        "; `sublimit tessellate -o FILE.ply` writes it");
  Mesh read = read_mesh(path);
  std::vector<Mesh::Values> found;
  for (const std::string& name : properties) {
    const auto values = std::ranges::find(read.vertex_values, name, &Mesh::Values::name);
    if (values != read.vertex_values.end()) found.push_back(std::move(*values));
  }
  if (found.size() != properties.size())
    for (const std::string& warning : read.warnings)  // numbers that are none are why one of them is left out
      if (std::ranges::any_of(properties, [&](const std::string& name) { return warning.find(name) != warning.npos; }))
        throw FormatError(warning);
  if (found.size() != properties.size())
    throw FormatError(
        path.string() +
        ": its vertices have no place_face, place_u and place_v; `sublimit tessellate -o FILE.ply` writes "
        "them");
  if (found[0].type == ValueType::float32 || found[0].type == ValueType::float64)
    throw FormatError(path.string() + ": place_face should have an integer type");
  PlacedFaces faces{{}, std::move(read.face_sizes), std::move(read.face_vertices)};
  faces.places.reserve(found[0].values.size());
  for (size_t i = 0; i < found[0].values.size(); ++i) {
    constexpr double most = std::numeric_limits<Index>::max();
    if (!(std::abs(found[0].values[i]) <= most))
      throw FormatError(path.string() + ": vertex " + std::to_string(i) + ": place_face " +
                        format_number(found[0].values[i]) + " is no number of a face");
    faces.places.push_back({static_cast<Index>(found[0].values[i]), found[1].values[i], found[2].values[i]});
  }
  return faces;
}

void check_places(const PlacedFaces& read, FaceCount faces, const std::string& name) {
  for (size_t i = 0; i < read.places.size(); ++i) {
    const Place& s = read.places[i];
    if (!is_inside(faces, s)) check_place(faces, s.face, s.u, s.v, name + ": vertex " + std::to_string(i) + ": ");
  }
}

}  // namespace sublimit

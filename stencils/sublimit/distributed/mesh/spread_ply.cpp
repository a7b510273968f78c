// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/ply_values.h"

namespace sublimit {
namespace {

/// Bytes of a row; nothing where rows have lists.
std::optional<std::int64_t> row_size(const PlyElement& element) {
  std::int64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.length) return std::nullopt;
    size += byte_size(property.type);
  }
  return size;
}

/// Elements and properties of a binary .ply that are a mesh's.
struct PlyPlaces {
  const PlyElement *vertex = nullptr, *face = nullptr;
  std::int64_t first_vertex = 0, vertex_size = 0, first_face = 0;  ///< bytes
  std::size_t list = 0;
};

PlyPlaces places_of(const PlyHeader& header, std::string_view bytes, const std::string& name) {
  PlyPlaces places;
  std::int64_t at = header.size;
  for (const PlyElement& element : header.elements) {
    if (element.name == "face") {
      places.face = &element, places.first_face = at;
      break;
    }
    const std::optional<std::int64_t> size = row_size(element);
    if (!size)
      throw FormatError(name + ": rows of element '" + element.name +
                        "' have lists; nothing but faces may, where each rank reads its own bytes");
    if (element.name == "vertex") places.vertex = &element, places.first_vertex = at, places.vertex_size = *size;
    if (*size > 0 && element.count > (std::ssize(bytes) - at) / *size)
      throw FormatError(name + ": the data ends before the header's counts are met");
    at += *size * element.count;
  }
  if (!places.vertex || !places.face || places.vertex->count == 0 || places.face->count == 0)
    throw InvalidMesh(name +
                      ": a mesh has elements 'vertex' with x, y and z and, behind them, 'face' with vertex_indices");
  const auto& properties = places.face->properties;
  const auto is_list = [](const PlyProperty& p) { return p.name == "vertex_indices" || p.name == "vertex_index"; };
  places.list = size_t(std::ranges::find_if(properties, is_list) - properties.begin());
  if (places.list == properties.size() || !properties[places.list].length || !is_integer(properties[places.list].type))
    throw FormatError(name + ": element 'face' has no list 'vertex_indices' of integers");
  return places;
}

Points own_vertices(const Ranks& ranks, const PlyPlaces& places, std::string_view bytes, PlyHeader header,
                    const std::string& name, const Runs& runs) {
  const std::int64_t first = runs.begin(ranks.rank()), count = runs.size(ranks.rank());
  const auto& properties = places.vertex->properties;
  std::vector<int> column(properties.size(), -1);
  for (int k = 0; k < 3; ++k) {
    const std::string wanted(1, "xyz"[k]);
    const auto found = std::ranges::find(properties, wanted, &PlyProperty::name);
    if (found == properties.end()) throw FormatError(name + ": element 'vertex' has no number '" + wanted + "'");
    column[size_t(found - properties.begin())] = k;
  }
  Points positions(count, 3);
  header.size = places.first_vertex + first * places.vertex_size;
  PlyBinaryValues values(bytes, header, name);
  for (std::int64_t v = 0; v < count; ++v)
    for (size_t i = 0; i < properties.size(); ++i) {
      const double value = values.real(properties[i].type);
      if (column[i] < 0) continue;
      if (!std::isfinite(value))
        throw InvalidMesh(fmt::format("{}coordinate {} of vertex {} is {}; it should be a finite number",
                                      values.place(), properties[i].name, first + v, value));
      positions(v, column[i]) = value;
    }
  return positions;
}

/// One face after the other, as far as they begin before a byte.
class PlyFaces {
 public:
  PlyFaces(const PlyPlaces& places, std::string_view bytes, PlyHeader header, std::int64_t begin,
           const std::string& name)
      : places_(places), values_(bytes, at(header, begin), name) {}
  std::int64_t offset = 0;

  /// Corners of the next face.
  void next(std::vector<std::int64_t>& corners, std::int64_t face) {
    corners.clear();
    for (size_t i = 0; i < places_.face->properties.size(); ++i) {
      const PlyProperty& property = places_.face->properties[i];
      const std::int64_t count = property.length ? values_.integer(*property.length) : 1;
      if (property.length) offset += byte_size(*property.length);
      if (i == places_.list && (count < 3 || count > std::numeric_limits<std::int32_t>::max()))
        throw InvalidMesh(
            fmt::format("{}face {} has {} corners; it should have at least 3", values_.place(), face, count));
      if (count < 0) throw FormatError(values_.place() + "a list of less than no values");
      if (i == places_.list) {
        for (std::int64_t k = 0; k < count; ++k) corners.push_back(values_.integer(property.type));
      } else {
        values_.skip(property.type, count);
      }
      offset += count * byte_size(property.type);
    }
  }

 private:
  const PlyHeader& at(PlyHeader& header, std::int64_t begin) {
    offset = header.size = begin;
    return header;
  }
  const PlyPlaces& places_;
  PlyBinaryValues values_;
};

/// Equal runs, if all rows are as long as the first: every rank looks whether its own are, and the first one's begin
/// where they should, so all of them do if all ranks say so.
bool read_equal_rows(const Ranks& ranks, const PlyPlaces& places, std::string_view bytes, const PlyHeader& header,
                     const std::string& name, SpreadMesh& mesh) {
  const Runs runs = Runs::equal(places.face->count, ranks.size());
  bool is_equal = true;
  try {
    std::vector<std::int64_t> corners;
    PlyFaces first(places, bytes, header, places.first_face, name);
    first.next(corners, 0);
    const auto size = static_cast<std::int32_t>(corners.size());
    const std::int64_t row = first.offset - places.first_face, own = runs.size(ranks.rank());
    if (row > (std::ssize(bytes) - places.first_face) / places.face->count)
      throw FormatError("more bytes than there are");
    PlyFaces faces(places, bytes, header, places.first_face + runs.begin(ranks.rank()) * row, name);
    mesh.face_vertices.reserve(static_cast<size_t>(size * own));
    for (std::int64_t f = 0; f < own && is_equal; ++f) {
      const std::int64_t begin = faces.offset;
      faces.next(corners, f);
      mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
      is_equal = std::ssize(corners) == size && faces.offset - begin == row;
    }
    mesh.face_sizes.assign(static_cast<size_t>(own), size);
  } catch (const Error&) {
    is_equal = false;  // or it is wrong somewhere: who reads row by row tells where
  }
  if (ranks.all(is_equal)) return true;
  mesh.face_sizes.clear(), mesh.face_vertices.clear();
  return false;
}

/// Those that begin in a rank's own bytes. Rows are of any length, so each rank hands on where the next one begins.
void read_own_faces(const Ranks& ranks, const PlyPlaces& places, std::string_view bytes, const PlyHeader& header,
                    const std::string& name, SpreadMesh& mesh) {
  if (read_equal_rows(ranks, places, bytes, header, name, mesh)) {
    mesh.faces = Runs(ranks, std::ssize(mesh.face_sizes));
    return;
  }
  const Runs parts = Runs::equal(std::ssize(bytes) - places.first_face, ranks.size());
  const std::int64_t until = places.first_face + parts.begin(ranks.rank()) + parts.size(ranks.rank());
  // Pages come from the disk on all ranks at once, not in the order of the ranks.
  unsigned char touched = 0;
  for (std::int64_t at = until - parts.size(ranks.rank()); at < until; at += 4096)
    touched = static_cast<unsigned char>(touched ^ static_cast<unsigned char>(bytes[size_t(at)]));
  if (ranks.rank() < 0) fmt::print("{}", touched);  // which is never so: the loop must stay
  const auto [end, count] = ranks.handed_on({places.first_face, 0}, [&](std::array<std::int64_t, 2> begin) {
    PlyFaces faces(places, bytes, header, begin[0], name);
    std::vector<std::int64_t> corners;
    std::int64_t face = begin[1];
    for (; face < places.face->count && faces.offset < until; ++face) {
      faces.next(corners, face);
      mesh.face_sizes.push_back(static_cast<std::int32_t>(corners.size()));
      mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
    }
    return std::array{faces.offset, face};
  });
  ranks.together([&, faces = count] {
    if (faces < places.face->count) throw FormatError(name + ": the data ends before the header's counts are met");
  });
  mesh.faces = Runs(ranks, std::ssize(mesh.face_sizes));
}

}  // namespace

SpreadMesh read_ply_parts(const Ranks& ranks, std::string_view bytes, const std::string& name) {
  SpreadMesh mesh;
  PlyHeader header;
  PlyPlaces places;
  ranks.together([&] {
    header = parse_ply_header(bytes, name);
    if (header.encoding == PlyHeader::Encoding::text)
      throw FormatError(name +
                        ": a .ply of text has no rows of known length; write a binary one, an .obj or a .safetensors");
    places = places_of(header, bytes, name);
    check_room(ranks, double(places.face->count), name);
    mesh.vertices = Runs::equal(places.vertex->count, ranks.size());
    mesh.positions = own_vertices(ranks, places, bytes, header, name, mesh.vertices);
  });
  read_own_faces(ranks, places, bytes, header, name, mesh);
  return mesh;
}

}  // namespace sublimit

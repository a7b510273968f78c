// SPDX-License-Identifier: Apache-2.0
// Meshes from files, each rank from its own bytes. Files are mapped: what a rank does not look at it does not have.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/base/mapped_file.h"
#include "sublimit/distributed/spread_mesh.h"
#include "sublimit/files/sidecar.h"
#include "sublimit/io/file_extension.h"
#include "sublimit/io/obj.h"
#include "sublimit/io/ply_header.h"
#include "sublimit/io/ply_values.h"
#include "sublimit/safetensors.h"

namespace sublimit {
namespace {

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A part's tags, their numbers after those of the ranks before.
void take_tags(const Ranks& ranks, const ControlMesh& from, SpreadMesh& mesh) {
  std::int64_t number = ranks.sum_before(std::ssize(from.creases) + std::ssize(from.corners));
  for (const auto& [tail, head, sharpness] : from.creases) mesh.creases.push_back({tail, head, sharpness, number++});
  for (const auto& [vertex, sharpness] : from.corners) mesh.corners.push_back({vertex, sharpness, number++});
  mesh.holes.assign(from.holes.begin(), from.holes.end());
  mesh.about.warnings = from.warnings;
  mesh.about.boundary = from.boundary, mesh.about.creasing = from.creasing, mesh.about.triangles = from.triangles;
  mesh.about.face_varying_interpolation = from.face_varying_interpolation;
}

/// A rule of the last rank that has it: the last one in the file wins.
template <class Rule>
void agree(const Ranks& ranks, std::optional<Rule>& rule) {
  const std::int64_t own = rule ? ranks.rank() * 16 + static_cast<int>(*rule) : -1;
  const std::int64_t last = ranks.largest(own);
  rule = last < 0 ? std::nullopt : std::optional(static_cast<Rule>(last % 16));
}

/// Where the line begins that a byte is in: behind a line end that no backslash takes back.
std::size_t line_begin(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size()) {
    const std::size_t end = text.find('\n', at - 1);
    if (end == std::string_view::npos) return text.size();
    std::size_t before = end;
    if (before > 0 && text[before - 1] == '\r') --before;
    if (before == 0 || text[before - 1] != '\\') return end + 1;
    at = end + 2;
  }
  return std::min(at, text.size());
}

SpreadMesh read_obj_parts(const Ranks& ranks, std::string_view text, const std::string& name) {
  const auto cut = [&](int rank) {
    return line_begin(text, text.size() / size_t(ranks.size()) * size_t(rank) +
                                text.size() % size_t(ranks.size()) * size_t(rank) / size_t(ranks.size()));
  };
  const std::size_t begin = cut(ranks.rank()),
                    end = ranks.rank() + 1 == ranks.size() ? text.size() : cut(ranks.rank() + 1);
  const std::string_view part = text.substr(begin, end - begin);
  ObjCounts own;
  ranks.together([&] {
    if (part.find('\0') != std::string_view::npos) throw FormatError(name + ": not a text OBJ file");
    own = count_obj(part);
  });
  const ObjCounts before{ranks.sum_before(own.lines), ranks.sum_before(own.vertices),
                         ranks.sum_before(own.texture_coordinates), ranks.sum_before(own.faces)};
  ControlMesh read;
  ranks.together([&] { read = parse_obj_part(part, name, before); });
  SpreadMesh mesh;
  mesh.vertices = Runs(ranks, read.num_vertices());
  mesh.faces = Runs(ranks, read.num_faces());
  mesh.positions = std::move(read.positions);
  mesh.face_sizes = std::move(read.face_sizes);
  mesh.face_vertices.assign(read.face_vertices.begin(), read.face_vertices.end());
  take_tags(ranks, read, mesh);
  agree(ranks, mesh.about.boundary);
  agree(ranks, mesh.about.creasing);
  agree(ranks, mesh.about.triangles);
  agree(ranks, mesh.about.face_varying_interpolation);
  const bool knots = !ranks.all(read.knot_intervals.empty());
  ranks.together([&] {
    if (knots)
      throw InvalidMesh(name + ": knot intervals are those of strips of faces, which no part sees to their ends");
  });
  return mesh;
}

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

/// Those that begin in a rank's own bytes. Rows are of any length, so each rank hands on where the next one begins.
void read_own_faces(const Ranks& ranks, const PlyPlaces& places, std::string_view bytes, const PlyHeader& header,
                    const std::string& name, SpreadMesh& mesh) {
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
    mesh.vertices = Runs::equal(places.vertex->count, ranks.size());
    mesh.positions = own_vertices(ranks, places, bytes, header, name, mesh.vertices);
  });
  read_own_faces(ranks, places, bytes, header, name, mesh);
  return mesh;
}

/// Numbers of a tensor, in any of its types that are integers or numbers.
template <class T>
std::vector<T> items(const Tensor& tensor, std::int64_t first, std::int64_t count, const std::string& name) {
  const auto convert = [&]<class From>(From) {
    std::vector<T> result(static_cast<size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      From value;
      std::memcpy(&value, tensor.bytes.data() + size_t(first + i) * sizeof(From), sizeof(From));
      result[size_t(i)] = static_cast<T>(value);
    }
    return result;
  };
  if constexpr (std::is_floating_point_v<T>) {
    if (tensor.dtype == DType::F64) return convert(double{});
    if (tensor.dtype == DType::F32) return convert(float{});
  } else {
    if (tensor.dtype == DType::I64) return convert(std::int64_t{});
    if (tensor.dtype == DType::I32) return convert(std::int32_t{});
  }
  throw FormatError(name + ": '" + tensor.name + "' has the type " + sublimit::name(tensor.dtype) +
                    (std::is_floating_point_v<T> ? "; F64 or F32 would do" : "; I64 or I32 would do"));
}

std::int64_t rows_of(const Tensor& tensor, std::int64_t columns, const std::string& name) {
  if (tensor.shape.size() == (columns == 1 ? 1u : 2u) && (columns == 1 || tensor.shape[1] == columns))
    return tensor.shape[0];
  throw FormatError(fmt::format("{}: '{}' should have the shape N{}", name, tensor.name,
                                columns == 1 ? std::string() : fmt::format(" x {}", columns)));
}

const Tensor& require(const Safetensors& file, const char* tensor, const std::string& name) {
  const Tensor* const found = file.find(tensor);
  if (found) return *found;
  throw FormatError(
      fmt::format("{}: no tensor '{}'; a mesh has 'positions', 'face_vertices' and, unless all faces have "
                  "as many corners, 'face_sizes'",
                  name, tensor));
}

SpreadMesh read_tensor_parts(const Ranks& ranks, std::span<const std::byte> bytes, const std::string& name) {
  SpreadMesh mesh;
  Safetensors file;
  std::int64_t own_corners = 0;
  const Tensor *corners = nullptr, *sizes = nullptr;
  ranks.together([&] {
    file = read_safetensors(bytes, name);
    const Tensor& positions = require(file, "positions", name);
    mesh.vertices = Runs::equal(rows_of(positions, 3, name), ranks.size());
    const std::int64_t first = mesh.vertices.begin(ranks.rank()), count = mesh.vertices.size(ranks.rank());
    const std::vector<double> x = items<double>(positions, 3 * first, 3 * count, name);
    mesh.positions = Eigen::Map<const Points>(x.data(), count, 3);
    if (!mesh.positions.allFinite()) throw InvalidMesh(name + ": 'positions' are not all finite numbers");
    corners = &require(file, "face_vertices", name);
    sizes = file.find("face_sizes");
    if (!sizes && corners->shape.size() != 2)
      throw FormatError(name +
                        ": 'face_vertices' has one dimension; then 'face_sizes' says how many corners each face has");
    mesh.faces = Runs::equal(sizes ? rows_of(*sizes, 1, name) : corners->shape[0], ranks.size());
    const std::int64_t faces = mesh.faces.size(ranks.rank());
    mesh.face_sizes = sizes ? items<std::int32_t>(*sizes, mesh.faces.begin(ranks.rank()), faces, name)
                            : std::vector<std::int32_t>(size_t(faces), static_cast<std::int32_t>(corners->shape[1]));
    for (const std::int32_t size : mesh.face_sizes) {
      if (size < 3) throw InvalidMesh(fmt::format("{}: a face has {} corners; it should have at least 3", name, size));
      own_corners += size;
    }
  });
  const std::int64_t before = ranks.sum_before(own_corners), all = ranks.sum(own_corners);
  ranks.together([&] {
    std::int64_t there = 1;
    for (const std::int64_t n : corners->shape) there *= n;
    if (there != all)
      throw FormatError(fmt::format("{}: 'face_vertices' has {} corners; 'face_sizes' says {}", name, there, all));
    mesh.face_vertices = items<std::int64_t>(*corners, before, own_corners, name);
    if (!ranks.is_first()) return;
    const auto sharp = [&](const char* tensor, const char* sharpness, std::int64_t columns, const auto& add) {
      const Tensor* const found = file.find(tensor);
      if (!found) return;
      const std::int64_t count = rows_of(*found, columns, name);
      const std::vector<std::int64_t> ids = items<std::int64_t>(*found, 0, count * columns, name);
      const Tensor& values = require(file, sharpness, name);
      if (rows_of(values, 1, name) != count)
        throw FormatError(fmt::format("{}: '{}' should have a number for each of '{}'", name, sharpness, tensor));
      const std::vector<float> s = items<float>(values, 0, count, name);
      for (std::int64_t i = 0; i < count; ++i) {
        if (!(s[size_t(i)] >= 0))
          throw FormatError(
              fmt::format("{}: '{}' has {}; a sharpness should be 0 or more", name, sharpness, s[size_t(i)]));
        add(&ids[size_t(i * columns)], s[size_t(i)], i);
      }
    };
    sharp("creases", "crease_sharpness", 2, [&](const std::int64_t* v, float s, std::int64_t i) {
      mesh.creases.push_back({v[0], v[1], s, i});
    });
    sharp("corners", "corner_sharpness", 1, [&](const std::int64_t* v, float s, std::int64_t i) {
      mesh.corners.push_back({v[0], s, i});
    });
    if (const Tensor* const holes = file.find("holes"))
      mesh.holes = items<std::int64_t>(*holes, 0, rows_of(*holes, 1, name), name);
  });
  return mesh;
}

/// Tags that lie beside the file take the place of its own of their kind.
void read_sidecar(const Ranks& ranks, const std::filesystem::path& path, SpreadMesh& mesh) {
  const std::optional<std::filesystem::path> sidecar = find_sidecar(path);
  const bool is_there = !ranks.all(!sidecar);
  if (!is_there) return;
  ControlMesh tags;  // NaN tells what the sidecar leaves alone
  tags.creases = {{-1, -1, 0}}, tags.corners = {{-1, 0}}, tags.holes = {-1};
  ranks.together([&] {
    constexpr std::int64_t most = std::numeric_limits<Index>::max();
    apply_sidecar_text(tags, read_file(*sidecar), sidecar->string(),
                  MeshCounts{static_cast<Index>(std::min(most, mesh.vertices.size())),
                             static_cast<Index>(std::min(most, mesh.faces.size()))});
    if (!tags.knot_intervals.empty())
      throw InvalidMesh(sidecar->string() +
                        ": knot intervals are those of strips of faces, which no part sees to their ends");
  });
  const auto is_kept = [](const auto& list, Index first) { return list.size() == 1 && first < 0; };
  if (!is_kept(tags.creases, tags.creases.empty() ? 0 : tags.creases[0].tail)) {
    mesh.creases.clear();
    for (const auto& [tail, head, sharpness] : tags.creases)
      if (ranks.is_first()) mesh.creases.push_back({tail, head, sharpness, std::ssize(mesh.creases)});
  }
  if (!is_kept(tags.corners, tags.corners.empty() ? 0 : tags.corners[0].vertex)) {
    mesh.corners.clear();
    for (const auto& [vertex, sharpness] : tags.corners)
      if (ranks.is_first()) mesh.corners.push_back({vertex, sharpness, std::ssize(mesh.corners)});
  }
  if (!is_kept(tags.holes, tags.holes.empty() ? 0 : tags.holes[0])) {
    mesh.holes.clear();
    if (ranks.is_first()) mesh.holes.assign(tags.holes.begin(), tags.holes.end());
  }
  if (tags.boundary) mesh.about.boundary = tags.boundary;
  if (tags.creasing) mesh.about.creasing = tags.creasing;
  if (tags.triangles) mesh.about.triangles = tags.triangles;
  if (tags.face_varying_interpolation) mesh.about.face_varying_interpolation = tags.face_varying_interpolation;
  if (ranks.is_first())
    mesh.about.warnings.insert(mesh.about.warnings.end(), tags.warnings.begin(), tags.warnings.end());
}

}  // namespace

SpreadMesh read_spread_mesh(const Ranks& ranks, const std::filesystem::path& path) {
  const std::string name = path.string(), extension = file_extension(path);
  MappedFile file;
  ranks.together([&] {
    file = map_file(path);
    if (extension != ".obj" && extension != ".ply" && extension != ".safetensors")
      throw FormatError(name + ": unknown kind of mesh '" + extension +
                        "'; .obj, binary .ply and .safetensors can be read");
  });
  check_alike(ranks, std::to_string(file.bytes.size()), "bytes in " + name);
  SpreadMesh mesh = extension == ".obj"   ? read_obj_parts(ranks, text_of(file.bytes), name)
                    : extension == ".ply" ? read_ply_parts(ranks, text_of(file.bytes), name)
                                          : read_tensor_parts(ranks, file.bytes, name);
  read_sidecar(ranks, path, mesh);
  check(ranks, mesh, name);
  return mesh;
}

SpreadMesh spread(const Ranks& ranks, const ControlMesh& whole) {
  SpreadMesh mesh;
  const bool first = ranks.is_first();
  mesh.vertices = Runs(ranks, first ? whole.num_vertices() : 0);
  mesh.faces = Runs(ranks, first ? whole.num_faces() : 0);
  mesh.positions.resize(0, 3);
  if (first) {
    mesh.positions = whole.positions;
    mesh.face_sizes = whole.face_sizes;
    mesh.face_vertices.assign(whole.face_vertices.begin(), whole.face_vertices.end());
  }
  take_tags(ranks, first ? whole : ControlMesh{}, mesh);
  return mesh;
}

void check(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name) {
  ranks.together([&] {
    const std::int64_t vertices = mesh.vertices.size(), faces = mesh.faces.size();
    if (vertices == 0) throw InvalidMesh(name + ": no vertices");
    if (faces == 0) throw InvalidMesh(name + ": no faces");
    const auto require = [&](std::int64_t id, std::int64_t count, const std::string& what, const char* are) {
      if (id < 0 || id >= count)
        throw InvalidMesh(
            fmt::format("{}: {} {} is out of range; there are {}, 0 to {}", name, what, id, count, count - 1, are));
    };
    size_t at = 0;
    for (size_t f = 0; f < mesh.face_sizes.size(); ++f)
      for (std::int32_t k = 0; k < mesh.face_sizes[f]; ++k) {
        const std::int64_t v = mesh.face_vertices[at++];
        if (v < 0 || v >= vertices)
          require(v, vertices, fmt::format("vertex of face {}:", mesh.faces.begin(ranks.rank()) + std::int64_t(f)), "");
      }
    for (const SpreadMesh::Crease& crease : mesh.creases)
      for (const std::int64_t v : {crease.tail, crease.head}) require(v, vertices, "vertex of a crease:", "");
    for (const SpreadMesh::Corner& corner : mesh.corners) require(corner.vertex, vertices, "vertex of a corner:", "");
    for (const std::int64_t f : mesh.holes) require(f, faces, "hole: face", "");
  });
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/detail/writer_parts.h"

namespace sublimit {
namespace {

constexpr std::int64_t ply_rows_per_block = 4096;
constexpr bool is_little_endian = std::endian::native == std::endian::little;

/// Puts down the bytes of a number, least first, and moves behind them.
template <class T>
void put(char*& at, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (!is_little_endian) std::reverse(bytes, bytes + sizeof value);
  std::memcpy(at, bytes, sizeof value);
  at += sizeof value;
}

/// Puts down a number in a type: the nearest that it has.
void put_as(char*& at, ValueType type, double value) {
  const auto whole = [&]<class T>(T) {
    put(at, static_cast<T>(std::clamp(std::nearbyint(value), double{std::numeric_limits<T>::min()},
                                      double{std::numeric_limits<T>::max()})));
  };
  switch (type) {
    case ValueType::int8:
      return whole(std::int8_t{});
    case ValueType::uint8:
      return whole(std::uint8_t{});
    case ValueType::int16:
      return whole(std::int16_t{});
    case ValueType::uint16:
      return whole(std::uint16_t{});
    case ValueType::int32:
      return whole(std::int32_t{});
    case ValueType::uint32:
      return whole(std::uint32_t{});
    case ValueType::float32:
      return put(at, static_cast<float>(std::clamp(value, -double{std::numeric_limits<float>::max()},
                                                   double{std::numeric_limits<float>::max()})));
    case ValueType::float64:
      return put(at, value);
  }
}

/// Puts down the length of a list.
void put_length(char*& at, PlyType type, std::int64_t length) {
  if (type == PlyType::uint8)
    put(at, static_cast<std::uint8_t>(length));
  else
    put(at, static_cast<std::uint32_t>(length));
}

/// Makes room for bytes at the end of `out`.
char* extend(std::string& out, std::size_t bytes) {
  const std::size_t size = out.size();
  out.resize(size + bytes);
  return out.data() + size;
}

/// Properties that are written beside positions and corners.
struct Extras {
  std::vector<const Mesh::Values*> vertex_values, face_values;
  const Mesh::FaceVarying* texture = nullptr;  ///< null: none
  std::vector<std::string> dropped;            ///< names that are taken: those of values which are left out

  explicit Extras(const Mesh& mesh) {
    std::vector<std::string_view> taken;
    if (mesh.normals.rows() > 0) taken.insert(taken.end(), {"nx", "ny", "nz"});
    if (mesh.texture.rows() > 0) taken.insert(taken.end(), {"s", "t"});
    vertex_values = named(mesh.vertex_values, taken);
    taken.clear();
    if (!mesh.face_ids.empty()) taken.push_back("face_id");
    face_values = named(mesh.face_values, taken);
    if (!mesh.face_varying.empty() && mesh.face_varying[0].values.cols() == 2) texture = mesh.face_varying.data();
  }

 private:
  /// A file has each name once: that of values which come later or have a field of their own.
  std::vector<const Mesh::Values*> named(const std::vector<Mesh::Values>& all,
                                         const std::vector<std::string_view>& taken) {
    std::vector<const Mesh::Values*> kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto has_name = [&](const Mesh::Values& other) { return other.name == all[i].name; };
      if (std::ranges::find(taken, all[i].name) == taken.end() &&
          std::none_of(all.begin() + std::ptrdiff_t(i) + 1, all.end(), has_name))
        kept.push_back(&all[i]);
      else
        dropped.push_back(all[i].name);
    }
    return kept;
  }
};

std::size_t bytes_of(const std::vector<const Mesh::Values*>& values) {
  std::size_t bytes = 0;
  for (const Mesh::Values* const one : values) bytes += static_cast<std::size_t>(byte_size(one->type));
  return bytes;
}

/// Types of the lengths of lists. Nearly all readers expect one byte: only lists that need more get more.
struct Lengths {
  PlyType corners = PlyType::uint8, texture = PlyType::uint8;
  explicit Lengths(const Mesh& mesh) {
    const auto any_above = [&](Index most) {
      return std::ranges::any_of(mesh.face_sizes, [&](Index size) { return size > most; });
    };
    if (any_above(255)) corners = PlyType::uint32;
    if (any_above(127)) texture = PlyType::uint32;
  }
};

std::string format_header(const Mesh& mesh, const Extras& extras, const Lengths& lengths) {
  PlyElement vertex{.name = "vertex", .count = mesh.positions.rows(), .properties = {}};
  PlyElement face{.name = "face", .count = std::ssize(mesh.face_sizes), .properties = {}};
  const auto add_double = [&](const char* name) { vertex.properties.push_back({name, PlyType::float64, {}}); };
  for (const char* const name : {"x", "y", "z"}) add_double(name);
  if (mesh.normals.rows() > 0)
    for (const char* const name : {"nx", "ny", "nz"}) add_double(name);
  if (mesh.texture.rows() > 0)
    for (const char* const name : {"s", "t"}) add_double(name);
  for (const Mesh::Values* const one : extras.vertex_values) vertex.properties.push_back({one->name, one->type, {}});
  face.properties.push_back({"vertex_indices", PlyType::int32, lengths.corners});
  if (extras.texture) face.properties.push_back({"texcoord", PlyType::float32, lengths.texture});
  if (!mesh.face_ids.empty()) face.properties.push_back({"face_id", PlyType::int32, {}});
  for (const Mesh::Values* const one : extras.face_values) face.properties.push_back({one->name, one->type, {}});
  return format_ply_header({PlyHeader::Encoding::little_endian, {std::move(vertex), std::move(face)}},
                           format_comments(mesh.comments, "comment "));
}

void emit_vertices(const Mesh& mesh, const Extras& extras, RowWriter& out) {
  const bool normals = mesh.normals.rows() > 0, texture = mesh.texture.rows() > 0;
  const std::size_t bytes_of_vertex =
      sizeof(double) * (3 + (normals ? 3 : 0) + (texture ? 2 : 0)) + bytes_of(extras.vertex_values);
  const double* const positions = mesh.positions.data();
  if (is_little_endian && bytes_of_vertex == 3 * sizeof(double))  // they lie in memory as they should in the file
    return out.write({reinterpret_cast<const char*>(positions), std::size_t(mesh.positions.size()) * sizeof(double)});
  out.rows(mesh.positions.rows(), ply_rows_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    char* at = extend(bytes, std::size_t(end - begin) * bytes_of_vertex);
    for (std::int64_t v = begin; v < end; ++v) {
      for (int i = 0; i < 3; ++i) put(at, positions[3 * v + i]);
      for (int i = 0; normals && i < 3; ++i) put(at, mesh.normals.data()[3 * v + i]);
      for (int i = 0; texture && i < 2; ++i) put(at, mesh.texture.data()[2 * v + i]);
      for (const Mesh::Values* const one : extras.vertex_values) put_as(at, one->type, one->values[std::size_t(v)]);
    }
  });
}

void emit_faces(const Mesh& mesh, const Extras& extras, const Lengths& lengths, RowWriter& out) {
  const std::vector<std::size_t> first = first_corners(mesh.face_sizes, ply_rows_per_block);
  const std::size_t num_corners = mesh.face_vertices.size();
  const auto num_faces = std::ssize(mesh.face_sizes);
  const std::size_t bytes_of_face = static_cast<std::size_t>(byte_size(lengths.corners)) +
                                    (extras.texture ? static_cast<std::size_t>(byte_size(lengths.texture)) : 0) +
                                    (mesh.face_ids.empty() ? 0 : sizeof(Index)) + bytes_of(extras.face_values);
  const std::size_t bytes_of_corner = sizeof(Index) + (extras.texture ? 2 * sizeof(float) : 0);
  out.rows(num_faces, ply_rows_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    std::size_t corner = first[std::size_t(begin / ply_rows_per_block)];
    const std::size_t last = end == num_faces ? num_corners : first[std::size_t(end / ply_rows_per_block)];
    char* at = extend(bytes, std::size_t(end - begin) * bytes_of_face + (last - corner) * bytes_of_corner);
    for (std::int64_t face = begin; face < end; ++face) {
      const Index size = mesh.face_sizes[std::size_t(face)];
      put_length(at, lengths.corners, size);
      for (std::size_t c = corner; c < corner + std::size_t(size); ++c) put(at, mesh.face_vertices[c]);
      if (extras.texture) {
        put_length(at, lengths.texture, 2 * std::int64_t{size});
        for (std::size_t c = corner; c < corner + std::size_t(size); ++c)
          for (int i = 0; i < 2; ++i)
            put(at, static_cast<float>(extras.texture->values(extras.texture->indices[c], i)));
      }
      corner += std::size_t(size);
      if (!mesh.face_ids.empty()) put(at, mesh.face_ids[std::size_t(face)]);
      for (const Mesh::Values* const one : extras.face_values) put_as(at, one->type, one->values[std::size_t(face)]);
    }
  });
}

void emit_ply(const Mesh& mesh, RowWriter out) {
  const Extras extras(mesh);
  const Lengths lengths(mesh);
  out.write(format_header(mesh, extras, lengths));
  emit_vertices(mesh, extras, out);
  emit_faces(mesh, extras, lengths, out);
}

/// Checks the names of values.
/// @param shape  names that are not free
void check_names(const std::vector<Mesh::Values>& all, std::span<const std::string_view> shape,
                 const std::string& name) {
  for (const Mesh::Values& one : all) {
    const bool is_word = !one.name.empty() && one.name.find_first_of(" \t\v\f\r\n#") == std::string::npos;
    if (!is_word || std::ranges::find(shape, one.name) != shape.end())
      throw InvalidParameter(name + ": values cannot have the name " + in_quotes(one.name) +
                             " in a PLY file; a word without blanks and # that is not taken can be written");
  }
}

void check(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  constexpr std::string_view of_vertices[] = {"x", "y", "z"},
                             of_faces[] = {"vertex_indices", "vertex_index", "texcoord"};
  check_names(mesh.vertex_values, of_vertices, name);
  check_names(mesh.face_values, of_faces, name);
  if (const Mesh::FaceVarying* const texture = Extras(mesh).texture)
    if ((texture->values.array().abs() > std::numeric_limits<float>::max()).any())
      throw InvalidMesh(name + ": a texture coordinate is beyond the numbers of 32 bits that a PLY file has for it");
  if (mesh.face_normals.empty()) return;
  throw InvalidParameter(name + ": a PLY file has one normal per vertex, these are per corner; write an .obj");
}

}  // namespace

std::vector<std::string> changes_in_ply(const Mesh& mesh) {
  std::vector<std::string> changes;
  const Extras extras(mesh);
  for (const std::string& name : extras.dropped)
    changes.push_back("values " + in_quotes(name) + " are left out: the file has other numbers of that name");
  for (const std::vector<const Mesh::Values*>* const values : {&extras.vertex_values, &extras.face_values})
    for (const Mesh::Values* const one : *values) {
      const PlyRange range = range_of(one->type);
      const auto beyond = std::ranges::count_if(one->values, [&](double x) {
        const double written = is_integer(one->type) ? std::nearbyint(x) : x;
        return std::isfinite(x) && (written < range.least || written > range.most);
      });
      if (beyond > 0)
        changes.push_back("values " + in_quotes(one->name) + " beyond the type " + range.name + ", " +
                          format_number(beyond) + " of them, are cut off");
    }
  return changes;
}

std::string format_ply(const Mesh& mesh) {
  check(mesh, "PLY");
  std::string bytes;
  emit_ply(mesh, RowWriter(bytes));
  return bytes;
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check(mesh, path.string());
  AtomicFile file(path, progress);
  emit_ply(mesh, RowWriter(file));
  file.commit();
}

}  // namespace sublimit

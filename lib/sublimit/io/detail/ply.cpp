// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/ply_values.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

/// Reads the elements of a file in the order of its header. `Values` is PlyTextValues or PlyBinaryValues.
template <class Values>
class PlyReader {
 public:
  /// @param further  names of properties of vertices
  PlyReader(std::string_view bytes, const PlyHeader& header, std::string_view name,
            std::span<const std::string> further)
      : header_(header), name_(name), further_(further), values_(bytes, header, name) {}

  Mesh read() {
    num_vertices_ = checked_index(require("vertex", "x, y and z").count, name_, "vertices");
    checked_index(require("face", "vertex_indices").count, name_, "faces");
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip(element);
      }
    }
    if (!values_.at_end()) mesh_.warnings.push_back(values_.place() + "data behind the last element ignored");
    return std::move(mesh_);
  }

 private:
  const PlyElement& require(const char* name, const char* properties) const {
    for (const PlyElement& element : header_.elements) {
      if (element.name != name) continue;
      if (element.count > 0) return element;
      throw InvalidMesh(name_ + ": no elements '" + name + "'; a mesh should have some");
    }
    throw InvalidMesh(name_ + ": no element '" + name + "'; a mesh should have one with " + properties);
  }

  [[noreturn]] void fail(const PlyElement& element, const std::string& what) const {
    throw FormatError(name_ + ":" + format_number(element.line) + ": " + what);
  }

  // Position of a named property; its names are unique.
  std::size_t find(const PlyElement& element, std::string_view name) const {
    const auto is_it = [&](const PlyProperty& property) { return property.name == name; };
    const auto found = std::find_if(element.properties.begin(), element.properties.end(), is_it);
    if (found != element.properties.end() &&
        std::find_if(found + 1, element.properties.end(), is_it) != element.properties.end()) {
      fail(element, "element '" + element.name + "' has two properties " + in_quotes(name));
    }
    return static_cast<std::size_t>(found - element.properties.begin());
  }

  void skip(const PlyProperty& property) { values_.skip(property.type, property.length ? length(property) : 1); }

  std::int64_t length(const PlyProperty& property) {
    const std::int64_t length = values_.integer(*property.length);
    if (length >= 0) return length;
    throw FormatError(values_.place() + "list of " + format_number(length) + " values; it should be 0 or more");
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;  // takes no data, whatever its count
    for (std::int64_t row = 0; row < element.count; ++row) {
      values_.begin_row();
      for (const PlyProperty& property : element.properties) skip(property);
      values_.end_row();
    }
  }

  void read_vertices(const PlyElement& element) {
    std::vector<Index> column(element.properties.size(), -1);
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    for (Index i = 0; i < 3; ++i) {
      const std::size_t found = find(element, names[static_cast<std::size_t>(i)]);
      if (found == element.properties.size() || element.properties[found].length) {
        fail(element, std::string("element 'vertex' has no number '") + names[static_cast<std::size_t>(i)] +
                          "'; it should have x, y and z");
      }
      column[found] = i;
    }
    for (const std::string& name : further_) {
      const std::size_t found = find(element, name);
      if (found == element.properties.size() || element.properties[found].length) continue;
      column[found] = static_cast<Index>(3 + mesh_.vertex_values.size());
      mesh_.vertex_values.push_back(
          {name, std::vector<double>(std::size_t(num_vertices_)), is_integer(element.properties[found].type)});
    }
    mesh_.positions.resize(num_vertices_, 3);  // the file is long enough for three columns of so many rows
    for (Index v = 0; v < num_vertices_; ++v) {
      values_.begin_row();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (column[i] < 0) {
          skip(element.properties[i]);
          continue;
        }
        const double value = values_.real(element.properties[i].type);
        if (column[i] >= 3) {
          mesh_.vertex_values[std::size_t(column[i] - 3)].values[std::size_t(v)] = value;
          continue;
        }
        mesh_.positions(v, column[i]) = value;
        if (std::isfinite(value)) continue;
        throw InvalidMesh(values_.place() + "coordinate " + element.properties[i].name + " of vertex " +
                          format_number(v) + " is " + format_number(value) + "; it should be a finite number");
      }
      values_.end_row();
    }
  }

  void read_faces(const PlyElement& element) {
    std::size_t list = find(element, "vertex_indices");
    if (list == element.properties.size()) list = find(element, "vertex_index");
    if (list == element.properties.size() || !element.properties[list].length) {
      fail(element, "element 'face' has no list 'vertex_indices' or 'vertex_index'");
    }
    if (!is_integer(element.properties[list].type)) fail(element, "indices of vertices should have an integer type");
    for (std::int64_t f = 0; f < element.count; ++f) {
      values_.begin_row();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == list) {
          read_face(f, element.properties[i]);
        } else {
          skip(element.properties[i]);
        }
      }
      values_.end_row();
    }
  }

  void read_face(std::int64_t face, const PlyProperty& property) {
    const std::int64_t size = length(property);
    if (size < 3) {
      throw InvalidMesh(values_.place() + "face " + format_number(face) + " has " + format_number(size) +
                        " corners; it should have at least 3");
    }
    for (std::int64_t i = 0; i < size; ++i) {  // ends with the data at the latest
      const std::int64_t vertex = values_.integer(property.type);
      if (vertex < 0 || vertex >= num_vertices_) {
        throw InvalidMesh(values_.place() + "index " + format_number(vertex) + " of face " + format_number(face) +
                          " is out of range; the file has " + format_number(num_vertices_) + " vertices, 0 to " +
                          format_number(num_vertices_ - 1));
      }
      mesh_.face_vertices.push_back(static_cast<Index>(vertex));
    }
    checked_index(std::int64_t(mesh_.face_vertices.size()), name_, "corners of faces");
    mesh_.face_sizes.push_back(static_cast<Index>(size));
  }

  const PlyHeader& header_;
  std::string name_;
  std::span<const std::string> further_;
  Values values_;
  Mesh mesh_;
  Index num_vertices_ = 0;
};

}  // namespace

Mesh read_ply(const std::filesystem::path& path) { return parse_ply(read_file(path), path.string()); }

Mesh parse_ply(std::string_view bytes, std::string_view name) { return parse_ply(bytes, name, {}); }

Mesh read_ply(const std::filesystem::path& path, std::span<const std::string> names) {
  return parse_ply(read_file(path), path.string(), names);
}

Mesh parse_ply(std::string_view bytes, std::string_view name, std::span<const std::string> names) {
  const PlyHeader header = parse_ply_header(bytes, name);
  return header.encoding == PlyHeader::Encoding::text ? PlyReader<PlyTextValues>(bytes, header, name, names).read()
                                                      : PlyReader<PlyBinaryValues>(bytes, header, name, names).read();
}

}  // namespace sublimit

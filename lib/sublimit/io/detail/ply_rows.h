// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of the elements of a PLY file that make a mesh: `vertex` with x, y and z, `face` with the list `vertex_indices`
// or `vertex_index`. `Values` is PlyTextValues or PlyBinaryValues and stands where a row begins, so a reader may start
// anywhere in the data.
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/ply_values.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

/// Returns the element of a mesh.
/// @param properties  what it has, for the message
/// @throws InvalidMesh  the file has no such element, or none of its kind
const PlyElement& require_element(const PlyHeader& header, const std::string& file, std::string_view name,
                                  std::string_view properties);

/// Reads the number of values of a list.
template <class Values>
std::int64_t read_length(Values& values, const PlyProperty& list) {
  const std::int64_t length = values.integer(*list.length);
  if (length >= 0) return length;
  throw FormatError(values.place() + "list of " + format_number(length) + " values; it should be 0 or more");
}

/// Skips a property of a row.
template <class Values>
void skip(Values& values, const PlyProperty& property) {
  values.skip(property.type, property.length ? read_length(values, property) : 1);
}

/// Skips all rows of an element.
template <class Values>
void skip(Values& values, const PlyElement& element) {
  if (element.properties.empty()) return;  // takes no data, whatever its count
  for (std::int64_t row = 0; row < element.count; ++row) {
    values.begin_row();
    for (const PlyProperty& property : element.properties) skip(values, property);
    values.end_row();
  }
}

/// Rows of the element `vertex`. Keeps a reference to the element.
class PlyVertices {
 public:
  /// @param further  names of properties to read besides x, y and z; those that the element lacks are left out
  /// @throws FormatError  no numbers x, y and z; two properties of a name
  PlyVertices(const PlyElement& vertex, const std::string& file, std::span<const std::string> further);
  PlyVertices(const PlyElement&&, const std::string&, std::span<const std::string>) = delete;

  /// Returns the further properties that the element has.
  const std::vector<const PlyProperty*>& further() const { return further_; }

  /// Reads a row.
  /// @param number  number of the vertex, for messages
  /// @param out     x, y, z and the further properties
  /// @throws InvalidMesh  coordinates that are not finite;  FormatError  as `values`
  template <class Values>
  void read(Values& values, std::int64_t number, std::span<double> out) const {
    values.begin_row();
    for (std::size_t i = 0; i < column_.size(); ++i) {
      const PlyProperty& property = vertex_->properties[i];
      if (column_[i] < 0) {
        skip(values, property);
        continue;
      }
      const double value = out[std::size_t(column_[i])] = values.real(property.type);
      if (column_[i] < 3 && !std::isfinite(value))
        throw InvalidMesh(values.place() + "coordinate " + property.name + " of vertex " + format_number(number) +
                          " is " + format_number(value) + "; it should be a finite number");
    }
    values.end_row();
  }

 private:
  const PlyElement* vertex_;
  std::vector<const PlyProperty*> further_;
  std::vector<int> column_;  // of each property in a row of numbers, -1: none
};

/// Rows of the element `face`. Keeps a reference to the element.
class PlyFaces {
 public:
  /// @param num_vertices  number of vertices of the whole mesh
  /// @throws FormatError  no list of indices
  PlyFaces(const PlyElement& face, const std::string& file, std::int64_t num_vertices);
  PlyFaces(const PlyElement&&, const std::string&, std::int64_t) = delete;

  /// Reads a row and appends the vertices of the face. Returns how many these are.
  /// @param number  number of the face, for messages
  /// @throws InvalidMesh  fewer than 3 corners, indices out of range;  FormatError  as `values`
  template <class Values, class Int>
  Index read(Values& values, std::int64_t number, std::vector<Int>& vertices) const {
    Index size = 0;
    values.begin_row();
    for (std::size_t i = 0; i < face_->properties.size(); ++i) {
      if (i == list_)
        size = read_list(values, number, vertices);
      else
        skip(values, face_->properties[i]);
    }
    values.end_row();
    return size;
  }

 private:
  template <class Values, class Int>
  Index read_list(Values& values, std::int64_t number, std::vector<Int>& vertices) const {
    const PlyProperty& list = face_->properties[list_];
    const std::int64_t size = read_length(values, list);
    if (size < 3)
      throw InvalidMesh(values.place() + "face " + format_number(number) + " has " + format_number(size) +
                        " corners; it should have at least 3");
    for (std::int64_t i = 0; i < size; ++i) {  // ends with the data at the latest
      const std::int64_t vertex = values.integer(list.type);
      if (vertex < 0 || vertex >= num_vertices_)
        throw InvalidMesh(values.place() + "index " + format_number(vertex) + " of face " + format_number(number) +
                          " is out of range; the file has " + format_number(num_vertices_) + " vertices, 0 to " +
                          format_number(num_vertices_ - 1));
      vertices.push_back(static_cast<Int>(vertex));
    }
    return checked_index(size, file_, "corners of a face");
  }

  const PlyElement* face_;
  std::string file_;
  std::int64_t num_vertices_;
  std::size_t list_;
};

}  // namespace sublimit

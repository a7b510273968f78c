// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of the elements of a PLY file that make a mesh: `vertex` with x, y and z, `face` with the list `vertex_indices`
// or `vertex_index`, and further numbers of both. `Values` is PlyTextValues or PlyBinaryValues and stands where a row
// begins, so a reader may start anywhere in the data.
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

/// Returns the names of an element's numbers in the order of the file, without those of two properties.
/// @param except  names to leave out
std::vector<std::string> names_of_numbers(const PlyElement& element, std::span<const std::string_view> except);

/// Returns the position of the list of indices, `vertex_indices` or `vertex_index`, among an element's properties.
/// @throws FormatError  there is no such list of integers
std::size_t find_indices(const PlyElement& element, const std::string& file);

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

/// Checks an index of a vertex.
/// @param of, number  whose it is, for the message: "face", 3
/// @throws InvalidMesh  out of range
template <class Values>
void check_vertex(const Values& values, std::int64_t vertex, std::int64_t num_vertices, std::string_view of,
                  std::int64_t number) {
  if (vertex >= 0 && vertex < num_vertices) return;
  throw InvalidMesh(values.place() + "index " + format_number(vertex) + " of " + std::string(of) + " " +
                    format_number(number) + " is out of range; the file has " + format_number(num_vertices) +
                    " vertices, 0 to " + format_number(num_vertices - 1));
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
  /// @param further       names of numbers to read besides the corners; those that the element lacks are left out
  /// @throws FormatError  no list of indices
  PlyFaces(const PlyElement& face, const std::string& file, std::int64_t num_vertices,
           std::span<const std::string> further = {});
  PlyFaces(const PlyElement&&, const std::string&, std::int64_t, std::span<const std::string> = {}) = delete;

  /// Returns the further numbers that the element has.
  const std::vector<const PlyProperty*>& further() const { return further_; }
  /// Returns the list `texcoord`: two texture coordinates for each corner; null if there is none.
  const PlyProperty* texture() const { return texture_ < column_.size() ? &face_->properties[texture_] : nullptr; }

  /// Reads a row and appends the vertices of the face. Returns how many these are.
  /// @param number  number of the face, for messages
  /// @throws InvalidMesh  fewer than 3 corners, indices out of range;  FormatError  as `values`
  template <class Values, class Int>
  Index read(Values& values, std::int64_t number, std::vector<Int>& vertices) const {
    return read(values, number, vertices, {}, nullptr);
  }
  /// Reads the same with what else is known of a face.
  /// @param further  the further numbers, or empty
  /// @param texture  the list `texcoord` is appended to it; or null
  template <class Values, class Int>
  Index read(Values& values, std::int64_t number, std::vector<Int>& vertices, std::span<double> further,
             std::vector<double>* texture) const {
    Index size = 0;
    values.begin_row();
    for (std::size_t i = 0; i < face_->properties.size(); ++i) {
      const PlyProperty& property = face_->properties[i];
      if (i == list_) {
        size = read_list(values, number, vertices);
      } else if (column_[i] >= 0 && !further.empty()) {
        further[std::size_t(column_[i])] = values.real(property.type);
      } else if (i == texture_ && texture) {
        for (std::int64_t left = read_length(values, property); left > 0; --left)  // ends with the data at the latest
          texture->push_back(values.real(property.type));
      } else {
        skip(values, property);
      }
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
      check_vertex(values, vertex, num_vertices_, "face", number);
      vertices.push_back(static_cast<Int>(vertex));
    }
    return checked_index(size, file_, "corners of a face");
  }

  const PlyElement* face_;
  std::string file_;
  std::int64_t num_vertices_;
  std::size_t list_, texture_;  // positions of properties
  std::vector<const PlyProperty*> further_;
  std::vector<int> column_;  // of each property in `further_`, -1: none
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of the element `tristrips` of a PLY file: triangles as strips, in a list `vertex_indices`. Three indices in a
// row are a triangle, every other one of which is the other way round; -1 begins a new strip.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sublimit/io/detail/ply_rows.h"

namespace sublimit {

/// Rows of the element `tristrips`. Keeps a reference to the element.
class PlyStrips {
 public:
  /// @param num_vertices  number of vertices of the whole mesh
  /// @throws FormatError  no list of indices
  PlyStrips(const PlyElement& strips, const std::string& file, std::int64_t num_vertices)
      : strips_(&strips), num_vertices_(num_vertices), list_(find_indices(strips, file)) {}
  PlyStrips(const PlyElement&&, const std::string&, std::int64_t) = delete;

  /// Reads a row and appends the vertices of its triangles. Those with two equal vertices, with which strips turn
  /// corners, are left out.
  /// @param number  number of the row, for messages
  /// @throws InvalidMesh  indices out of range;  FormatError  as `values`
  template <class Values>
  void read(Values& values, std::int64_t number, std::vector<Index>& vertices) const {
    values.begin_row();
    for (std::size_t i = 0; i < strips_->properties.size(); ++i) {
      if (i == list_)
        read_list(values, number, vertices);
      else
        skip(values, strips_->properties[i]);
    }
    values.end_row();
  }

 private:
  template <class Values>
  void read_list(Values& values, std::int64_t number, std::vector<Index>& vertices) const {
    const PlyProperty& list = strips_->properties[list_];
    Index a = -1, b = -1;  // the last two vertices
    bool turned = false;
    for (std::int64_t left = read_length(values, list); left > 0; --left) {  // ends with the data at the latest
      const std::int64_t vertex = values.integer(list.type);
      if (vertex == -1 || (list.type == PlyType::uint32 && vertex == std::numeric_limits<std::uint32_t>::max())) {
        a = b = -1;
        turned = false;
        continue;
      }
      check_vertex(values, vertex, num_vertices_, "strip", number);
      const auto c = static_cast<Index>(vertex);
      if (a >= 0) {
        if (a != b && b != c && c != a) vertices.insert(vertices.end(), {turned ? b : a, turned ? a : b, c});
        turned = !turned;
      }
      a = b;
      b = c;
    }
  }

  const PlyElement* strips_;
  std::int64_t num_vertices_;
  std::size_t list_;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A caller's own faces, looked at where they are: nothing is copied, nothing is owned.
#include <span>

#include "sublimit/core/types.h"
#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// Faces as one array of vertices, all faces one after the other, counter-clockwise.
struct MeshView {
  Index num_vertices = 0;
  std::span<const Index> face_vertices;
  std::span<const Index> face_sizes;  ///< corners of each face; empty if every face has `face_size`
  Index face_size = 0;                ///< used if `face_sizes` is empty

  Index num_faces() const {
    return face_sizes.empty() ? (face_size ? static_cast<Index>(face_vertices.size()) / face_size : 0)
                              : static_cast<Index>(face_sizes.size());
  }
};

inline MeshView view(const ControlMesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.face_vertices, .face_sizes = mesh.face_sizes};
}

/// Faces of an Eigen matrix, one row each (`F` of libigl and friends): triangles or quads.
/// @pre  row-major and contiguous, which is what makes a view possible.
template <int Columns>
MeshView view(Index num_vertices, const Eigen::Matrix<Index, Eigen::Dynamic, Columns, Eigen::RowMajor>& faces) {
  return {.num_vertices = num_vertices,
          .face_vertices = {faces.data(), static_cast<std::size_t>(faces.size())},
          .face_sizes = {},
          .face_size = static_cast<Index>(faces.cols())};
}

}  // namespace sublimit

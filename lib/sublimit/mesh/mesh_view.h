// SPDX-License-Identifier: Apache-2.0
#pragma once
// A view of the faces of a mesh in the caller's own arrays. Nothing is copied, nothing is owned.
//
//   const std::vector<Index> quads = {0, 1, 4, 3, 1, 2, 5, 4};
//   const MeshView faces = {.num_vertices = 6, .face_vertices = quads, .face_sizes = {}, .face_size = 4};
//   const Topology topology(faces);
#include <span>

#include "sublimit/core/types.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Faces in one array of vertices. The arrays must outlive the view; threads may read it together.
struct MeshView {
  Index num_vertices = 0;
  std::span<const Index> face_vertices;  ///< vertices of all faces, one after the other, counter-clockwise
  std::span<const Index> face_sizes;     ///< corners of each face; empty if every face has `face_size`
  Index face_size = 0;                   ///< used if `face_sizes` is empty

  Index num_faces() const {
    return face_sizes.empty() ? (face_size ? static_cast<Index>(face_vertices.size()) / face_size : 0)
                              : static_cast<Index>(face_sizes.size());
  }
};

/// Returns a view of the faces of a mesh, which must outlive it.
inline MeshView view(const Mesh& mesh) {
  return {.num_vertices = mesh.num_vertices(), .face_vertices = mesh.face_vertices, .face_sizes = mesh.face_sizes};
}

/// Returns a view of the faces in an Eigen matrix, #F x corners (`F` of libigl, row-major); it must outlive the view.
template <int Columns>
MeshView view(Index num_vertices, const Eigen::Matrix<Index, Eigen::Dynamic, Columns, Eigen::RowMajor>& faces) {
  return {.num_vertices = num_vertices,
          .face_vertices = {faces.data(), static_cast<std::size_t>(faces.size())},
          .face_sizes = {},
          .face_size = static_cast<Index>(faces.cols())};
}

}  // namespace sublimit

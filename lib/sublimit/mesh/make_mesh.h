// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes of arrays:
//
//   const std::vector<std::array<float, 3>> points = ...;
//   const std::vector<std::array<int, 4>> quads = ...;
//   const ControlMesh mesh = make_mesh(points, quads);
//
// Eigen's matrices are taken too, `make_mesh(V, F)`, and faces of several sizes as `std::vector<std::vector<int>>`.
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// @throws InvalidMesh  always: `what` so many coordinates
[[noreturn]] inline void throw_not_three(const std::string& what, std::int64_t count) {
  throw InvalidMesh(what + " " + std::to_string(count) + " coordinates; 3 are right");
}

/// Makes a mesh of points and faces. Connectivity is checked where the mesh is used.
/// @param points         #V x 3
/// @param face_sizes     corners of each face
/// @param face_vertices  vertices of all faces, one after the other, counter-clockwise, from 0
inline ControlMesh make_mesh(Points points, std::vector<Index> face_sizes, std::vector<Index> face_vertices) {
  ControlMesh mesh;
  mesh.positions = std::move(points);
  mesh.face_sizes = std::move(face_sizes);
  mesh.face_vertices = std::move(face_vertices);
  return mesh;
}

/// Makes a mesh of a list of points, of three coordinates each, and a list of faces, of their vertices each.
/// @throws InvalidMesh  a point with another number of coordinates: says which
template <class PointList, class FaceList>
requires requires(const PointList& points, const FaceList& faces) {
  double((*std::begin(points))[2]);
  Index(*std::begin(*std::begin(faces)));
}
ControlMesh make_mesh(const PointList& points, const FaceList& faces) {
  Points rows(Index(std::size(points)), 3);
  Index row = 0;
  for (const auto& point : points) {
    if (std::size(point) != 3) throw_not_three("point " + std::to_string(row) + " has", std::int64_t(std::size(point)));
    rows.row(row++) << double(point[0]), double(point[1]), double(point[2]);
  }
  std::vector<Index> sizes, vertices;
  for (const auto& face : faces) {
    sizes.push_back(Index(std::size(face)));
    for (const auto& vertex : face) vertices.push_back(Index(vertex));
  }
  return make_mesh(std::move(rows), std::move(sizes), std::move(vertices));
}

/// Makes a mesh of Eigen's matrices: #V x 3 coordinates, #F x n vertices.
/// @throws InvalidMesh  another number of columns
template <class V, class F>
ControlMesh make_mesh(const Eigen::MatrixBase<V>& points, const Eigen::MatrixBase<F>& faces) {
  if (points.cols() != 3) throw_not_three("points have", points.cols());
  std::vector<Index> vertices;
  vertices.reserve(size_t(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (Eigen::Index c = 0; c < faces.cols(); ++c) vertices.push_back(Index(faces(f, c)));
  return make_mesh(Points(points.template cast<double>()),
                   std::vector<Index>(size_t(faces.rows()), Index(faces.cols())), std::move(vertices));
}

}  // namespace sublimit

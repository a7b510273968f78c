// SPDX-License-Identifier: Apache-2.0
#pragma once
// Makes meshes from arrays:
//
//   const std::vector<std::array<float, 3>> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   const std::vector<std::array<int, 4>> quads = {{0, 1, 2, 3}};
//   const Mesh mesh = make_mesh(points, quads);
//
// Eigen's matrices are accepted too, `make_mesh(V, F)`, and faces of several sizes as `std::vector<std::vector<int>>`.
// Flat arrays, as graphics APIs use them, are of float or double and may have any stride:
//
//   const std::vector<float> floats = {0, 0, 0, 1, 0, 0, 0, 1, 0};
//   const std::vector<Index> indices = {0, 1, 2};
//   const Mesh triangle = make_mesh(std::span(floats), 3, std::span(indices), 3);
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reports points with another number of coordinates than 3.
/// @param what  subject and verb of the message: "point 5 has"
/// @throws InvalidMesh  always
[[noreturn]] inline void throw_not_three(const std::string& what, std::int64_t count) {
  throw InvalidMesh(what + " " + std::to_string(count) + " coordinates; 3 are right");
}

/// Makes a mesh of points and faces. Connectivity is checked where the mesh is used.
/// @param points         #V x 3
/// @param face_sizes     corners of each face
/// @param face_vertices  vertices of all faces, one after the other, counter-clockwise, from 0
inline Mesh make_mesh(Points points, std::vector<Index> face_sizes, std::vector<Index> face_vertices) {
  Mesh mesh;
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
Mesh make_mesh(const PointList& points, const FaceList& faces) {
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

/// Makes a mesh of flat arrays.
/// @param numbers   x, y, z of a point in every `stride` numbers, of float or double
/// @param stride    numbers from one point to the next, 3 or more; the last point may end with its z
/// @param vertices  of faces of `face_size` corners each, one after the other, counter-clockwise, from 0
/// @throws InvalidParameter  a stride below 3, numbers that are no whole points, vertices that are no whole faces
template <class Real>
Mesh make_mesh(std::span<const Real> numbers, std::size_t stride, std::span<const Index> vertices, Index face_size) {
  if (stride < 3) throw InvalidParameter("stride is " + std::to_string(stride) + "; 3 or more is right");
  if (face_size < 1 || vertices.size() % std::size_t(face_size) != 0)
    throw InvalidParameter(std::to_string(vertices.size()) + " vertices of faces with " + std::to_string(face_size) +
                           " corners each are no whole faces");
  if (numbers.size() % stride != 0 && numbers.size() % stride < 3)
    throw InvalidParameter(std::to_string(numbers.size()) + " numbers with " + std::to_string(stride) +
                           " from one point to the next are no whole points");
  Points points(Index((numbers.size() + stride - 3) / stride), 3);
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < 3; ++k) points(i, k) = double(numbers[std::size_t(i) * stride + std::size_t(k)]);
  return make_mesh(std::move(points), std::vector<Index>(vertices.size() / std::size_t(face_size), face_size),
                   {vertices.begin(), vertices.end()});
}
template <class Real, std::size_t N, std::size_t M>
Mesh make_mesh(std::span<Real, N> numbers, std::size_t stride, std::span<const Index, M> vertices, Index face_size) {
  return make_mesh<std::remove_const_t<Real>>(std::span<const Real>(numbers), stride, std::span<const Index>(vertices),
                                              face_size);
}
template <class Real, std::size_t N, std::size_t M>
Mesh make_mesh(std::span<Real, N> numbers, std::size_t stride, std::span<Index, M> vertices, Index face_size) {
  return make_mesh(numbers, stride, std::span<const Index>(vertices), face_size);
}

/// Makes a mesh of Eigen's matrices: #V x 3 coordinates, #F x n vertices.
/// @throws InvalidMesh  another number of columns
template <class V, class F>
Mesh make_mesh(const Eigen::MatrixBase<V>& points, const Eigen::MatrixBase<F>& faces) {
  if (points.cols() != 3) throw_not_three("points have", points.cols());
  std::vector<Index> vertices;
  vertices.reserve(size_t(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (Eigen::Index c = 0; c < faces.cols(); ++c) vertices.push_back(Index(faces(f, c)));
  return make_mesh(Points(points.template cast<double>()),
                   std::vector<Index>(size_t(faces.rows()), Index(faces.cols())), std::move(vertices));
}

}  // namespace sublimit

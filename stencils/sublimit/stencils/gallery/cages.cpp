// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/cages.h"

#include <Eigen/LU>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace sublimit::gallery {
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

/// [-1,1]^3; vertex i has the signs of the bits of i: x is bit 0, y bit 1, z bit 2.
Mesh cube() {
  Mesh mesh;
  mesh.positions.resize(8, 3);
  for (Index v = 0; v < 8; ++v)
    for (int axis = 0; axis < 3; ++axis) mesh.positions(v, axis) = (v >> axis & 1) ? 1 : -1;
  mesh.face_sizes.assign(6, 4);
  mesh.face_vertices = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  return mesh;
}

/// Every quad cut from the corner that `first(face, corners)` chooses.
template <class First>
Mesh cut(const Mesh& quads, const First& first) {
  Mesh mesh;
  mesh.positions = quads.positions;
  for (Index f = 0; f < quads.num_faces(); ++f) {
    const Index* corners = &quads.face_vertices[4 * f];
    const int k = first(f, corners);
    for (const int i : {k, k + 1, k + 2, k, k + 2, k + 3}) mesh.face_vertices.push_back(corners[i % 4]);
  }
  mesh.face_sizes.assign(2 * quads.face_sizes.size(), 3);
  return mesh;
}

/// On a face, inscribed in the same sphere as the cube.
Mesh tetrahedron() {
  Mesh mesh;
  mesh.positions.resize(4, 3);
  const double radius = std::sqrt(3.), r = std::sqrt(8.) / 3 * radius;
  mesh.positions.row(0) << 0, radius, 0;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3;
    mesh.positions.row(i + 1) << r * std::sin(angle), -radius / 3, r * std::cos(angle);
  }
  mesh.face_sizes.assign(4, 3);
  mesh.face_vertices = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  return mesh;
}

}  // namespace

std::vector<Cage> cages() {
  const Mesh quads = cube();
  const auto even = [](Index, const Index* corners) { return std::popcount(static_cast<unsigned>(corners[0])) % 2; };
  const auto irregular = [](Index face, const Index*) { return face == 5 ? 1 : 0; };
  return {{"cube", "Cube in quads", quads},
          {"cube-tetrahedral", "Cube in triangles, the diagonals on a tetrahedron", cut(quads, even)},
          {"cube-irregular", "Cube in triangles, the diagonals as they come", cut(quads, irregular)},
          {"tetrahedron", "Tetrahedron", tetrahedron()}};
}

double diameter(const Points& points) {
  double result = 0;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    result = std::max(result, (points.rowwise() - points.row(v)).rowwise().norm().maxCoeff());
  return result;
}

std::vector<Matrix3d> symmetries(const Points& points) {
  // A linear map is known from the images of three points.
  const Eigen::Index n = points.rows();
  const Matrix3d inverse = Matrix3d(points.topRows(3)).inverse();
  const double small = 1e-9 * diameter(points);
  const auto is_point = [&](const RowVector3d& x) {
    return (points.rowwise() - x).rowwise().norm().minCoeff() < small;
  };
  std::vector<Matrix3d> maps;
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index c = 0; c < n; ++c) {
        Matrix3d images;
        images << points.row(a), points.row(b), points.row(c);
        const Matrix3d map = (inverse * images).transpose();  // acts on columns
        if (!map.isUnitary(1e-9)) continue;
        bool all = true;
        for (Eigen::Index i = 0; all && i < n; ++i) all = is_point((map * points.row(i).transpose()).transpose());
        if (all) maps.push_back(map);
      }
  return maps;
}

}  // namespace sublimit::gallery

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/small_meshes.h"

#include <cmath>
#include <numbers>

namespace sublimit::report {
namespace {

void add_face(ControlMesh& mesh, const std::vector<Index>& face) {
  mesh.face_sizes.push_back(static_cast<Index>(face.size()));
  mesh.face_vertices.insert(mesh.face_vertices.end(), face.begin(), face.end());
}

double turns(Index i, Index n) { return 2 * std::numbers::pi * i / n; }

}  // namespace

ControlMesh prism(Index n) {
  ControlMesh mesh;
  mesh.positions.resize(2 * n, 3);
  std::vector<Index> top, bottom;
  for (Index i = 0; i < n; ++i) {
    for (const Index level : {0, 1})
      mesh.positions.row(level * n + i) << std::cos(turns(i, n)), std::sin(turns(i, n)), 1 - 2 * level;
    top.push_back(i);
    bottom.push_back(2 * n - 1 - i);
  }
  add_face(mesh, top);
  add_face(mesh, bottom);
  for (Index i = 0; i < n; ++i) add_face(mesh, {i, n + i, n + (i + 1) % n, (i + 1) % n});
  return mesh;
}

ControlMesh torus(Index m, Index n) {
  ControlMesh mesh;
  mesh.positions.resize(m * n, 3);
  const auto vertex = [&](Index i, Index j) { return i % m * n + j % n; };
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      const double r = 2 + std::cos(turns(j, n));
      mesh.positions.row(vertex(i, j)) << r * std::cos(turns(i, m)), r * std::sin(turns(i, m)), std::sin(turns(j, n));
      add_face(mesh, {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

ControlMesh grid(Index m, Index n) {
  ControlMesh mesh;
  mesh.positions.resize((m + 1) * (n + 1), 3);
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= m; ++i) mesh.positions.row(j * (m + 1) + i) << i, j, 0;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const Index v = j * (m + 1) + i;
      add_face(mesh, {v, v + 1, v + m + 2, v + m + 1});
    }
  return mesh;
}

}  // namespace sublimit::report

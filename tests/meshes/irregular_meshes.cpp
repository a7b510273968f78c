// SPDX-License-Identifier: Apache-2.0
#include "meshes/irregular_meshes.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace sublimit::testing {
namespace {

using Faces = std::vector<std::vector<Index>>;

/// Faces in which edges can be exchanged: where each directed edge is, and valences.
struct Editable {
  Faces faces;
  std::map<std::pair<Index, Index>, Index> face_of;
  std::vector<Index> valence;
  std::mt19937 random;

  Editable(const Mesh& mesh, unsigned seed) : valence(mesh.num_vertices(), 0), random(seed) {
    size_t at = 0;
    for (const Index size : mesh.face_sizes) {
      faces.emplace_back();
      for (Index i = 0; i < size; ++i) faces.back().push_back(mesh.face_vertices[at++]);
      enter(Index(faces.size()) - 1);
    }
    for (const auto& [edge, face] : face_of) ++valence[edge.first];
  }
  void enter(Index f) {
    for (size_t i = 0; i < faces[f].size(); ++i) face_of[{faces[f][i], faces[f][(i + 1) % faces[f].size()]}] = f;
  }
  /// An edge as the tail and head of a random corner: its face starts with it.
  std::pair<Index, Index> pick() {
    const Index f = pick_face();
    std::vector<Index>& face = faces[f];
    std::rotate(face.begin(), face.begin() + random() % face.size(), face.end());
    return {face[0], face[1]};
  }
  Index pick_face() {
    for (;;)
      if (const size_t f = random() % faces.size(); !faces[f].empty()) return Index(f);
  }
  /// The face at a directed edge, turned to start with it.
  std::vector<Index>& face_at(Index tail, Index head) {
    std::vector<Index>& face = faces[face_of.at({tail, head})];
    std::rotate(face.begin(), std::find(face.begin(), face.end(), tail), face.end());
    return face;
  }
  Mesh mesh(const Points& positions) const {
    Mesh result;
    result.positions = positions;
    for (const auto& face : faces) {
      if (face.empty()) continue;
      result.face_sizes.push_back(Index(face.size()));
      result.face_vertices.insert(result.face_vertices.end(), face.begin(), face.end());
    }
    return result;
  }
};

}  // namespace

Mesh bipyramid(Index n) {
  std::vector<Eigen::Vector3d> positions{{0, 0, 1}, {0, 0, -1}};
  Faces faces;
  for (Index i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    positions.emplace_back(std::cos(angle), std::sin(angle), 0.1 * (i % 2));
    faces.push_back({0, 2 + i, 2 + (i + 1) % n});
    faces.push_back({1, 2 + (i + 1) % n, 2 + i});
  }
  return make_mesh(positions, faces);
}

Mesh flipped(const Mesh& triangles, int flips, unsigned seed, Index most) {
  Editable m(triangles, seed);
  for (int tries = 0, done = 0; done < flips && tries < 100 * flips; ++tries) {
    const auto [a, b] = m.pick();
    const Index f = m.face_of.at({a, b}), g = m.face_of.at({b, a});
    const Index c = m.face_at(a, b)[2], d = m.face_at(b, a)[2];
    if (m.valence[a] == 3 || m.valence[b] == 3 || m.valence[c] == most || m.valence[d] == most) continue;
    if (c == d || m.face_of.contains({c, d})) continue;
    m.face_of.erase({a, b});
    m.face_of.erase({b, a});
    m.faces[f] = {a, d, c};
    m.faces[g] = {d, b, c};
    m.enter(f);
    m.enter(g);
    --m.valence[a], --m.valence[b], ++m.valence[c], ++m.valence[d];
    ++done;
  }
  return m.mesh(triangles.positions);
}

Mesh merged(const Mesh& mesh, int edges, unsigned seed, Index most) {
  Editable m(mesh, seed);
  for (int tries = 0, done = 0; done < edges && tries < 100 * edges; ++tries) {
    const auto [a, b] = m.pick();
    const Index f = m.face_of.at({a, b}), g = m.face_of.at({b, a});
    const std::vector<Index>&left = m.face_at(a, b), &right = m.face_at(b, a);
    if (m.valence[a] == 3 || m.valence[b] == 3 || Index(left.size() + right.size()) > most + 2) continue;
    const auto is_common = [&right = right](Index v) {
      return std::find(right.begin(), right.end(), v) != right.end();
    };
    if (f == g || std::count_if(left.begin(), left.end(), is_common) != 2) continue;
    std::vector<Index> both(left.begin() + 1, left.end());  // from b to the one before a
    both.insert(both.end(), right.begin() + 1, right.end());
    m.face_of.erase({a, b});
    m.face_of.erase({b, a});
    m.faces[g].clear();
    m.faces[f] = both;
    m.enter(f);
    --m.valence[a], --m.valence[b];
    ++done;
  }
  return m.mesh(mesh.positions);
}

namespace {

std::vector<NamedMesh> made_closed_triangle_meshes() {
  std::vector<NamedMesh> list;
  const auto add = [&](const std::string& name, const Mesh& mesh, unsigned seed = 1) {
    list.push_back({name, {}, jittered(mesh, 0.1, seed)});
  };
  add("tetrahedron", tetrahedron());
  add("octahedron", octahedron());
  add("icosahedron", icosahedron());
  add("torus_5_4", triangle_torus(5, 4));
  add("torus_9_8", triangle_torus(9, 8));
  for (Index n = 3; n <= 10; ++n) add("bipyramid_" + std::to_string(n), bipyramid(n));
  add("bipyramid_60", bipyramid(60));
  add("flipped_icosahedron", flipped(icosahedron(), 40));
  for (unsigned seed = 1; seed <= 4; ++seed)
    add("flipped_torus_" + std::to_string(seed), flipped(triangle_torus(9, 8), 200, seed), seed);
  return list;
}

std::vector<NamedMesh> made_closed_polygon_meshes() {
  std::vector<NamedMesh> list = made_closed_triangle_meshes();
  const auto add = [&](const std::string& name, const Mesh& mesh, unsigned seed = 1) {
    list.push_back({name, {}, jittered(mesh, 0.05, seed)});
  };
  add("cube", cube());
  add("quad_torus", torus(5, 4));
  add("pole", pole(5));
  for (const Index n : {5, 7, 10}) add("prism_" + std::to_string(n), prism(n));
  add("quads", quads_from_triangles(flipped(icosahedron(), 40)));
  for (unsigned seed = 1; seed <= 4; ++seed)
    add("merged_" + std::to_string(seed), merged(flipped(triangle_torus(9, 8), 200, seed), 90, seed), seed);
  return list;
}

}  // namespace

// Every process of a test asks more than once.
std::vector<NamedMesh> closed_triangle_meshes() {
  static const std::vector<NamedMesh> all = made_closed_triangle_meshes();
  return all;
}
std::vector<NamedMesh> closed_polygon_meshes() {
  static const std::vector<NamedMesh> all = made_closed_polygon_meshes();
  return all;
}

std::vector<NamedMesh> open_triangle_meshes() {
  std::vector<NamedMesh> list{{"triangle_grid", {}, jittered(triangle_grid(5, 4))}};
  for (const Index n : {2, 3, 5}) list.push_back({"open_fan_" + std::to_string(n), {}, jittered(open_fan(n, 3, 2))});
  for (const Index n : {3, 5, 6, 9}) list.push_back({"fan_" + std::to_string(n), {}, jittered(fan(n, 3, 3))});
  return list;
}

std::vector<NamedMesh> open_polygon_meshes() {
  std::vector<NamedMesh> list = open_triangle_meshes();
  list.push_back({"grid", {}, jittered(grid(5, 4))});
  list.push_back({"polygon_ring", {}, jittered(polygon_ring({3, 5, 4, 7, 6}))});
  for (const Index n : {2, 3, 5})
    list.push_back({"open_quad_fan_" + std::to_string(n), {}, jittered(open_fan(n, 4, 2))});
  for (const Index n : {3, 5, 9}) list.push_back({"quad_fan_" + std::to_string(n), {}, jittered(fan(n, 4, 2))});
  return list;
}

std::vector<SchemeOnMesh> schemes_on(const std::vector<std::string>& schemes, const std::vector<NamedMesh>& meshes) {
  std::vector<SchemeOnMesh> all;
  for (const std::string& scheme : schemes)
    for (const NamedMesh& mesh : meshes) all.push_back({scheme, mesh.name, mesh.mesh});
  return all;
}

}  // namespace sublimit::testing

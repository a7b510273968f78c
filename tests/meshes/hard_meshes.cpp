// SPDX-License-Identifier: Apache-2.0
#include "meshes/hard_meshes.h"

#include <algorithm>
#include <random>
#include <set>

#include "meshes/irregular_meshes.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit::testing {
namespace {

unsigned seed_of(std::mt19937& random) { return unsigned(random()); }

/// Faces of which `keep` is true, and the vertices that they have; untagged.
Mesh kept(const Mesh& mesh, const std::vector<char>& keep) {
  Mesh result;
  std::vector<Index> number(size_t(mesh.num_vertices()), -1);
  std::vector<Index> vertices;
  for (size_t f = 0, at = 0; f < keep.size(); at += size_t(mesh.face_sizes[f++])) {
    if (!keep[f]) continue;
    result.face_sizes.push_back(mesh.face_sizes[f]);
    for (size_t k = at; k < at + size_t(mesh.face_sizes[f]); ++k) {
      Index& v = number[size_t(mesh.face_vertices[k])];
      if (v < 0) {
        v = Index(vertices.size());
        vertices.push_back(mesh.face_vertices[k]);
      }
      result.face_vertices.push_back(v);
    }
  }
  result.positions = mesh.positions(vertices, Eigen::all);
  return result;
}

/// Without the faces around some vertices, as long as the mesh stays a manifold.
Mesh opened(Mesh mesh, int holes, std::mt19937& random) {
  for (int tries = 0; holes > 0 && tries < 200; ++tries) {
    const Topology t(view(mesh));
    const Vertex v{Index(random() % std::uint32_t(t.num_vertices()))};
    if (t.is_boundary(v) || t.num_faces(v) > 6) continue;
    std::vector<char> keep(size_t(t.num_faces()), 1);
    for (Index f = 0; f < t.num_faces(); ++f)
      for (const Index w : t.vertices(Face{f}))
        if (w == index(v)) keep[size_t(f)] = 0;
    Mesh candidate = kept(mesh, keep);
    const Topology c(view(candidate));
    if (!c.is_manifold() || !c.faults().empty()) continue;
    mesh = std::move(candidate);
    --holes;
  }
  return mesh;
}

/// Edges that continue a path as straight as connectivity has it, with some turns.
std::vector<Index> wander(const Topology& t, int steps, std::mt19937& random) {
  HalfEdge h{Index(random() % std::uint32_t(t.num_half_edges()))};
  std::vector<Index> path{index(t.tail(h)), index(t.head(h))};
  for (int k = 1; k < steps; ++k) {
    const std::vector<Edge> edges = t.edges(Vertex{path.back()});
    const Edge e = edges[random() % edges.size()];
    const Index next = index(t.tail(e)) == path.back() ? index(t.head(e)) : index(t.tail(e));
    if (std::find(path.begin(), path.end(), next) != path.end()) continue;
    path.push_back(next);
  }
  return path;
}

void add_semi_sharp(Mesh& mesh, std::mt19937& random) {
  const Topology t(view(mesh));
  const auto sharpness = [&] {
    return random() % 6 == 0 ? infinite_sharpness : 0.3f + 5.4f * float(random() % 1000) / 999;
  };
  for (int paths = 0; paths < 6; ++paths) {
    const std::vector<Index> path = wander(t, 3 + int(random() % 5), random);
    std::vector<float> values;
    for (size_t k = 1; k < path.size(); ++k) values.push_back(sharpness());
    add_crease(mesh, path, values);
  }
  add_crease(mesh, wander(t, 4, random), infinite_sharpness);  // with two darts
  for (int corners = 0; corners < 3; ++corners)
    mesh.corners.push_back({Index(random() % std::uint32_t(t.num_vertices())), sharpness()});
}

/// Infinitely sharp edges around random sets of faces: no path ends inside.
void add_sharp(Mesh& mesh, std::mt19937& random) {
  const Topology t(view(mesh));
  for (int sets = 0; sets < 3; ++sets) {
    std::set<Index> region{Index(random() % std::uint32_t(t.num_faces()))};
    for (int grow = 0; grow < 4; ++grow) {
      auto at = region.begin();
      std::advance(at, random() % region.size());
      const HalfEdge g = t.twin(t.corner(Face{*at}, Index(random() % std::uint32_t(t.size(Face{*at})))));
      if (exists(g)) region.insert(index(t.face(g)));
    }
    for (const Index f : region)
      for (Index k = 0; k < t.size(Face{f}); ++k) {
        const HalfEdge h = t.corner(Face{f}, k), g = t.twin(h);
        if (exists(g) && !region.contains(index(t.face(g))))
          mesh.creases.push_back({index(t.tail(h)), index(t.head(h)), infinite_sharpness});
      }
  }
}

Mesh finished(Mesh mesh, const Hardness& hardness, std::mt19937& random) {
  if (hardness.open) mesh = opened(std::move(mesh), 2, random);
  mesh = jittered(std::move(mesh), 0.05, seed_of(random));
  if (hardness.sharp) add_sharp(mesh, random);
  if (hardness.semi_sharp) add_semi_sharp(mesh, random);
  return mesh;
}

}  // namespace

Mesh hard_triangles(unsigned seed, const Hardness& hardness) {
  std::mt19937 random(seed);
  return finished(flipped(triangle_torus(9, 8), 200, seed_of(random), 12), hardness, random);
}

Mesh hard_polygons(unsigned seed, const Hardness& hardness) {
  std::mt19937 random(seed);
  // Half of the meshes are mostly quads, where regular places lie between irregular ones.
  const Mesh triangles = flipped(triangle_torus(9, 8), 200, seed_of(random), 12);
  const Mesh mesh = seed % 2 == 0 ? merged(triangles, 90, seed_of(random), 12)
                                  : merged(quads_from_triangles(flipped(icosahedron(), 60, seed_of(random), 12)), 12,
                                           seed_of(random), 12);
  return finished(mesh, hardness, random);
}

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#include "meshes/meshes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "sublimit/mesh/sharpness.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;
using Positions = std::vector<Eigen::Vector3d>;
using Path = std::vector<Index>;
using Faces = std::vector<std::vector<Index>>;

Eigen::Vector3d on_circle(double radius, double turns, double height = 0) {
  return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), height};
}

// Around a centre lie n sectors; (x,y) of sector s is x steps along its first side and y along its second, which is
// the first side of the next sector. Rings of quads have max(x,y), rings of triangles x+y in common.
Mesh sectors(Index n, Index face_size, Index rings, bool closed) {
  assert(face_size == 3 || face_size == 4);
  const bool triangles = face_size == 3;
  const double turns = closed ? 1.0 : 0.5 * std::min(1.0, 0.4 * n);
  std::map<std::array<Index, 3>, Index> numbers;
  Positions positions;
  const auto vertex = [&](Index s, Index x, Index y) {
    if (x == 0) std::swap(x, y), ++s;
    if (x == 0) s = 0;
    if (closed) s %= n;
    const auto [entry, is_new] = numbers.try_emplace({s, x, y}, static_cast<Index>(positions.size()));
    if (is_new) {
      const double r = triangles ? x + y : std::max(x, y) + 0.4 * std::min(x, y);
      const double t = x == 0 ? 0.0 : turns * (s + double(y) / (x + y)) / n;
      positions.push_back(on_circle(r, t, 0.1 * r * r * (1 - std::cos(4 * pi * t))));
    }
    return entry->second;
  };
  Faces faces;
  for (Index ring = 1; ring <= rings; ++ring) {
    for (Index s = 0; s < n; ++s) {
      for (Index x = 0; x < ring; ++x) {
        for (Index y = 0; y < ring; ++y) {
          if (triangles ? x + y == ring - 1 : std::max(x, y) == ring - 1) {
            faces.push_back({vertex(s, x, y), vertex(s, x + 1, y)});
            if (!triangles) faces.back().push_back(vertex(s, x + 1, y + 1));
            faces.back().push_back(vertex(s, x, y + 1));
          } else if (triangles && x + y == ring - 2) {
            faces.push_back({vertex(s, x + 1, y), vertex(s, x + 1, y + 1), vertex(s, x, y + 1)});
          }
        }
      }
    }
  }
  return make_mesh(positions, faces);
}

}  // namespace

Mesh make_mesh(const Positions& positions, const Faces& faces) {
  Mesh mesh;
  mesh.positions.resize(static_cast<Index>(positions.size()), 3);
  for (Index v = 0; v < mesh.num_vertices(); ++v) mesh.positions.row(v) = positions[v].transpose();
  for (const std::vector<Index>& face : faces) {
    mesh.face_sizes.push_back(static_cast<Index>(face.size()));
    mesh.face_vertices.insert(mesh.face_vertices.end(), face.begin(), face.end());
  }
  return mesh;
}

Mesh tetrahedron() {
  return make_mesh({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}});
}

Mesh cube() {
  Positions positions;
  for (int i = 0; i < 8; ++i) positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return make_mesh(positions, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

Mesh octahedron() {
  return make_mesh({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                   {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

Mesh icosahedron() {
  Positions positions;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-std::numbers::phi, std::numbers::phi}) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        positions.push_back(p);
      }
    }
  }
  const auto neighbors = [&](Index a, Index b) { return std::abs((positions[a] - positions[b]).norm() - 2) < 0.1; };
  Faces faces;
  for (Index a = 0; a < 12; ++a) {
    for (Index b = a + 1; b < 12; ++b) {
      for (Index c = a + 1; c < 12; ++c) {
        const bool outwards = positions[a].dot(positions[b].cross(positions[c])) > 0;
        if (neighbors(a, b) && neighbors(b, c) && neighbors(c, a) && outwards) faces.push_back({a, b, c});
      }
    }
  }
  return make_mesh(positions, faces);
}

Mesh torus(Index m, Index n) {
  Positions positions;
  Faces faces;
  const auto vertex = [&](Index i, Index j) { return i % m * n + j % n; };
  for (Index i = 0; i < m; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double t = double(j) / n;
      positions.push_back(on_circle(2 + std::cos(2 * pi * t), double(i) / m, std::sin(2 * pi * t)));
      faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return make_mesh(positions, faces);
}

Mesh triangle_torus(Index m, Index n) { return triangulated(torus(m, n)); }

Mesh grid(Index m, Index n) {
  Positions positions;
  Faces faces;
  for (Index j = 0; j <= n; ++j) {
    for (Index i = 0; i <= m; ++i) {
      positions.emplace_back(i + 0.1 * std::sin(2.3 * j), j + 0.1 * std::sin(1.7 * i + 1),
                             0.4 * std::sin(1.3 * i + 0.4) * std::cos(0.9 * j));
    }
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < m; ++i) {
      const Index v = j * (m + 1) + i;
      faces.push_back({v, v + 1, v + m + 2, v + m + 1});
    }
  }
  return make_mesh(positions, faces);
}

Mesh triangle_grid(Index m, Index n) { return triangulated(grid(m, n)); }

Mesh fan(Index n, Index face_size, Index rings) { return sectors(n, face_size, rings, true); }

Mesh open_fan(Index n, Index face_size, Index rings) { return sectors(n, face_size, rings, false); }

Mesh pole(Index n) {
  Positions positions{{0, 0, 1.5}, {0, 0, -1.5}};
  for (const double z : {0.7, -0.7}) {
    for (Index i = 0; i < n; ++i) positions.push_back(on_circle(1, double(i) / n, z));
  }
  Faces faces;
  for (Index i = 0; i < n; ++i) {
    const Index upper = 2 + i, lower = upper + n, next = 2 + (i + 1) % n, below_next = next + n;
    faces.push_back({0, upper, next});
    faces.push_back({upper, lower, below_next, next});
    faces.push_back({1, below_next, lower});
  }
  return make_mesh(positions, faces);
}

Mesh prism(Index n) {
  Positions positions;
  for (const double z : {0.8, -0.8}) {
    for (Index i = 0; i < n; ++i) positions.push_back(on_circle(1, double(i) / n, z));
  }
  Faces faces(2);
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    faces[0].push_back(i);
    faces[1].push_back(2 * n - 1 - i);
    faces.push_back({i, n + i, n + next, next});
  }
  return make_mesh(positions, faces);
}

Mesh polygon_ring(const std::vector<Index>& sizes) {
  assert(sizes.back() != 3);
  const Index n = static_cast<Index>(sizes.size());
  Positions positions;
  Faces faces(1);
  for (Index i = 0; i < n; ++i) {
    positions.push_back(on_circle(1, double(i) / n, 0.2 * std::sin(i)));
    faces[0].push_back(i);
  }
  std::vector<Index> spoke;  // outer end of the edge that leaves the polygon at vertex i; a triangle merges two
  for (Index i = 0; i < n; ++i) {
    if (i > 0 && sizes[i - 1] == 3) {
      spoke.push_back(spoke.back());
    } else {
      spoke.push_back(static_cast<Index>(positions.size()));
      positions.push_back(on_circle(2, double(i) / n, 0.3 * std::cos(2.0 * i)));
    }
  }
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> face{(i + 1) % n, i, spoke[i]};
    for (Index k = 4; k < sizes[i]; ++k) {
      face.push_back(static_cast<Index>(positions.size()));
      positions.push_back(on_circle(2.5, (i + (k - 3.0) / (sizes[i] - 3)) / n, 0.1 * k));
    }
    if (sizes[i] > 3) face.push_back(spoke[(i + 1) % n]);
    faces.push_back(face);
  }
  return make_mesh(positions, faces);
}

Mesh mobius_strip(Index n) {
  Positions positions;
  Faces faces;
  for (Index i = 0; i < n; ++i) {
    const double half_angle = pi * i / n;
    for (const double side : {-0.5, 0.5}) {
      positions.push_back(on_circle(2 + side * std::cos(half_angle), double(i) / n, side * std::sin(half_angle)));
    }
    const Index a = 2 * i, b = i + 1 < n ? a + 2 : 1;
    faces.push_back({a, b, b % 2 ? b - 1 : b + 1, a + 1});
  }
  return make_mesh(positions, faces);
}

Mesh jittered(Mesh mesh, double amount, unsigned seed) {
  std::mt19937 random(seed);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    for (Index k = 0; k < mesh.positions.cols(); ++k) {
      mesh.positions(v, k) += amount * (std::ldexp(double(random()), -31) - 1);  // not a std:: distribution: portable
    }
  }
  return mesh;
}

Mesh glued(const Mesh& a, const Mesh& b, const std::vector<Index>& a_vertices, const std::vector<Index>& b_vertices) {
  assert(a_vertices.size() == b_vertices.size());
  std::vector<Index> number(static_cast<std::size_t>(b.num_vertices()), -1);
  for (std::size_t i = 0; i < b_vertices.size(); ++i) number[b_vertices[i]] = a_vertices[i];
  Mesh mesh = a;
  mesh.positions.conservativeResize(a.num_vertices() + b.num_vertices() - static_cast<Index>(b_vertices.size()), 3);
  Index next = a.num_vertices();
  for (Index v = 0; v < b.num_vertices(); ++v) {
    if (number[v] >= 0) continue;
    mesh.positions.row(next) = b.positions.row(v);
    number[v] = next++;
  }
  mesh.face_sizes.insert(mesh.face_sizes.end(), b.face_sizes.begin(), b.face_sizes.end());
  for (const Index v : b.face_vertices) mesh.face_vertices.push_back(number[v]);
  for (const Mesh::Crease& c : b.creases) mesh.creases.push_back({number[c.tail], number[c.head], c.sharpness});
  for (const Mesh::Corner& c : b.corners) mesh.corners.push_back({number[c.vertex], c.sharpness});
  for (const Index f : b.holes) mesh.holes.push_back(a.num_faces() + f);
  return mesh;
}

Mesh disjoint_union(const Mesh& a, const Mesh& b) { return glued(a, b, {}, {}); }

Mesh quads_from_triangles(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, Index> midpoints;
  std::vector<Index> midpoint;  // per corner, of the edge that starts there
  const Index first_midpoint = mesh.num_vertices() + mesh.num_faces();
  Index first = 0;
  for (const Index size : mesh.face_sizes) {
    for (Index i = 0; i < size; ++i) {
      const auto ends = std::minmax(mesh.face_vertices[first + i], mesh.face_vertices[first + (i + 1) % size]);
      const Index next = first_midpoint + static_cast<Index>(midpoints.size());
      midpoint.push_back(midpoints.try_emplace(ends, next).first->second);
    }
    first += size;
  }

  Mesh result = mesh;
  result.face_sizes.assign(mesh.face_vertices.size(), 4);
  result.face_vertices.clear();
  result.holes.clear();
  result.positions.conservativeResize(first_midpoint + static_cast<Index>(midpoints.size()), 3);
  for (const auto& [ends, m] : midpoints) {
    result.positions.row(m) = (mesh.positions.row(ends.first) + mesh.positions.row(ends.second)) / 2;
  }
  first = 0;
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const Index size = mesh.face_sizes[f], center = mesh.num_vertices() + f;
    const bool hole = std::ranges::find(mesh.holes, f) != mesh.holes.end();
    result.positions.row(center).setZero();
    for (Index i = 0; i < size; ++i) {
      const Index v = mesh.face_vertices[first + i];
      if (hole) result.holes.push_back(static_cast<Index>(result.face_vertices.size()) / 4);
      for (const Index corner : {v, midpoint[first + i], center, midpoint[first + (i + size - 1) % size]}) {
        result.face_vertices.push_back(corner);
      }
      result.positions.row(center) += mesh.positions.row(v) / size;
    }
    first += size;
  }
  result.creases.clear();
  for (const Mesh::Crease& c : mesh.creases) {
    const Index m = midpoints.at(std::minmax(c.tail, c.head));
    result.creases.push_back({c.tail, m, c.sharpness});
    result.creases.push_back({m, c.head, c.sharpness});
  }
  return result;
}

void add_crease(Mesh& mesh, const Path& path, const std::vector<float>& sharpness) {
  assert(sharpness.size() + 1 == path.size());
  for (std::size_t i = 0; i + 1 < path.size(); ++i) mesh.creases.push_back({path[i], path[i + 1], sharpness[i]});
}

void add_crease(Mesh& mesh, const Path& path, float sharpness) {
  add_crease(mesh, path, std::vector<float>(path.size() - 1, sharpness));
}

// The tagged meshes.
namespace {

using Schemes = std::vector<std::string>;
const Schemes quad_schemes{"catmull-clark", "bilinear"};
const Schemes triangle_schemes{"loop", "catmull-clark"};

class Collection {
 public:
  void add(const std::string& name, const Mesh& mesh, const Schemes& schemes = quad_schemes) {
    meshes_.push_back({name, schemes, jittered(mesh, 0.08, static_cast<unsigned>(meshes_.size()) + 1)});
  }
  void add_triangles(const std::string& name, const Mesh& mesh) {
    add(name + "_triangles", triangulated(mesh), triangle_schemes);
  }
  void add_both(const std::string& name, const Mesh& mesh) {
    add(name, mesh);
    add_triangles(name, mesh);
  }
  std::vector<NamedMesh> take() { return std::move(meshes_); }

 private:
  std::vector<NamedMesh> meshes_;
};

Mesh with_options(Mesh mesh, Boundary boundary, Creasing creasing = Creasing::uniform,
                  Triangles triangles = Triangles::catmark) {
  mesh.boundary = boundary;
  mesh.creasing = creasing;
  mesh.triangles = triangles;
  return mesh;
}
Mesh chaikin(const Mesh& mesh) { return with_options(mesh, Boundary::edge_and_corner, Creasing::chaikin); }

Index grid_vertex(Index m, Index i, Index j) { return j * (m + 1) + i; }
Path grid_row(Index m, Index j, Index from, Index to) {
  Path path;
  for (Index i = from; i <= to; ++i) path.push_back(grid_vertex(m, i, j));
  return path;
}
Path grid_column(Index m, Index i, Index from, Index to) {
  Path path;
  for (Index j = from; j <= to; ++j) path.push_back(grid_vertex(m, i, j));
  return path;
}
// Around the axis of torus(m,n), back to the first vertex; around its tube.
Path torus_ring(Index m, Index n, Index j) {
  Path path;
  for (Index i = 0; i <= m; ++i) path.push_back(i % m * n + j);
  return path;
}
Path tube_ring(Index n, Index i) {
  Path path;
  for (Index j = 0; j <= n; ++j) path.push_back(i * n + j % n);
  return path;
}

// grid(6,6) with creases of two edges each leaving its middle: east, north, west, south.
Mesh star(const std::vector<float>& arms) {
  Mesh mesh = grid(6, 6);
  const Index center = grid_vertex(6, 3, 3);
  const std::array<Index, 4> steps{1, 7, -1, -7};
  for (std::size_t k = 0; k < arms.size(); ++k) {
    add_crease(mesh, {center, center + steps[k], center + 2 * steps[k]}, arms[k]);
  }
  return mesh;
}

// A strip of quads that stands on a path; a path that returns to its start makes a closed one.
Mesh with_fin(Mesh mesh, const Path& path, double lean = 0) {
  const bool closed = path.front() == path.back();
  const Index first = mesh.num_vertices(), count = static_cast<Index>(path.size()) - closed;
  mesh.positions.conservativeResize(first + count, 3);
  for (Index i = 0; i < count; ++i) {
    mesh.positions.row(first + i) = mesh.positions.row(path[i]) + Eigen::RowVector3d(0.3 * lean, lean, 1);
  }
  for (Index i = 0; i + 1 < static_cast<Index>(path.size()); ++i) {
    mesh.face_sizes.push_back(4);
    for (const Index v : {path[i], path[i + 1], first + (i + 1) % count, first + i}) mesh.face_vertices.push_back(v);
  }
  return mesh;
}

// Quads that share the edge (0,1), wound in turns.
Mesh book(Index pages) {
  Positions positions{{0, 0, 0}, {0, 0, 1}};
  Faces faces;
  for (Index k = 0; k < pages; ++k) {
    const Index lower = static_cast<Index>(positions.size()), upper = lower + 1;
    for (const double z : {0.0, 1.0}) positions.push_back(on_circle(1, double(k) / pages, z));
    if (k % 2 == 0) faces.push_back({0, lower, upper, 1});
    if (k % 2 == 1) faces.push_back({0, 1, upper, lower});
  }
  return make_mesh(positions, faces);
}

Mesh polygon(Index n) {
  Positions positions;
  Faces faces(1);
  for (Index i = 0; i < n; ++i) {
    positions.push_back(on_circle(1, double(i) / n, 0.2 * std::sin(2.0 * i)));
    faces[0].push_back(i);
  }
  return make_mesh(positions, faces);
}

Mesh flipped(Mesh mesh, Index face) {
  Index first = 0;
  for (Index f = 0; f < face; ++f) first += mesh.face_sizes[f];
  std::reverse(mesh.face_vertices.begin() + first, mesh.face_vertices.begin() + first + mesh.face_sizes[face]);
  return mesh;
}

Mesh with_face(Mesh mesh, Index face, const std::vector<Index>& vertices) {
  Index first = 0;
  for (Index f = 0; f < face; ++f) first += mesh.face_sizes[f];
  const auto at = mesh.face_vertices.begin() + first;
  mesh.face_vertices.insert(mesh.face_vertices.erase(at, at + mesh.face_sizes[face]), vertices.begin(), vertices.end());
  mesh.face_sizes[face] = static_cast<Index>(vertices.size());
  return mesh;
}

Mesh with_points(Mesh mesh, const Positions& points) { return disjoint_union(mesh, make_mesh(points, {})); }

Mesh every_second_face_triangulated(const Mesh& mesh) {
  Mesh result = mesh;
  result.face_sizes.clear();
  result.face_vertices.clear();
  Index first = 0;
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const Index* v = &mesh.face_vertices[first];
    if (f % 2 == 0) {
      result.face_sizes.push_back(4);
      result.face_vertices.insert(result.face_vertices.end(), v, v + 4);
    } else {
      result.face_sizes.insert(result.face_sizes.end(), {3, 3});
      result.face_vertices.insert(result.face_vertices.end(), {v[0], v[1], v[2], v[0], v[2], v[3]});
    }
    first += mesh.face_sizes[f];
  }
  return result;
}

std::string digits(float sharpness) {  // 2.7 -> "2_7"
  const long tenths = std::lround(10 * sharpness);
  std::string text = std::to_string(tenths / 10);
  if (tenths % 10) text.append(1, '_').append(std::to_string(tenths % 10));
  return text;
}

// Two n-gons with all vertices in common: valence 2 everywhere.
Mesh pillow(Index n) {
  const Mesh side = polygon(n);
  return glued(side, flipped(side, 0), side.face_vertices, side.face_vertices);
}

void add_smooth(Collection& meshes) {
  meshes.add("tetrahedron", tetrahedron(), triangle_schemes);
  meshes.add_both("cube", cube());
  meshes.add("octahedron", octahedron(), triangle_schemes);
  meshes.add("icosahedron", icosahedron(), triangle_schemes);
  meshes.add_both("torus", torus(5, 4));
  meshes.add_both("split_octahedron", quads_from_triangles(octahedron()));

  Mesh quads = fan(3, 4, 2), triangles = fan(3, 3, 2);
  for (const Index n : {5, 6, 9}) quads = disjoint_union(quads, fan(n, 4, 2));
  for (const Index n : {4, 5, 7, 9}) triangles = disjoint_union(triangles, fan(n, 3, 2));
  meshes.add("extraordinary_interior", quads);
  meshes.add("extraordinary_interior_triangles", triangles, triangle_schemes);

  meshes.add_both("pole_64", pole(64));
  meshes.add("pole_64_quads", fan(64, 4, 1));
  meshes.add("valence_2", disjoint_union(fan(2, 4, 1), fan(2, 4, 2)));
  meshes.add("valence_2_pillows", disjoint_union(pillow(3), disjoint_union(pillow(4), pillow(5))));
  meshes.add("valence_2_triangles", fan(2, 3, 1), triangle_schemes);
  Mesh creased = fan(2, 4, 2);
  add_crease(creased, {7, 1, 0, 3}, {0.6f, 1.5f, 2.2f});  // in along one spoke, out along the other
  meshes.add("valence_2_creased", creased);
}

void add_boundaries(Collection& meshes) {
  const std::pair<const char*, Boundary> modes[] = {
      {"none", Boundary::none}, {"edge_only", Boundary::edge_only}, {"edge_and_corner", Boundary::edge_and_corner}};
  for (const auto& [name, mode] : modes) {
    const std::string prefix = std::string("boundary_") + name;
    meshes.add_both(prefix, with_options(grid(4, 3), mode));
    meshes.add(prefix + "_lone_faces",
               with_options(disjoint_union(polygon(3), disjoint_union(polygon(4), polygon(7))), mode));
    meshes.add(prefix + "_lone_triangle", with_options(polygon(3), mode), triangle_schemes);
    meshes.add_both(prefix + "_two_faces", with_options(grid(2, 1), mode));
    Mesh quads = open_fan(1, 4, 2), triangles = open_fan(1, 3, 2);
    for (const Index n : {2, 3, 4, 5, 6, 7}) {
      quads = disjoint_union(quads, open_fan(n, 4, 2));
      triangles = disjoint_union(triangles, open_fan(n, 3, 2));
    }
    meshes.add(prefix + "_extraordinary", with_options(quads, mode));
    meshes.add(prefix + "_extraordinary_triangles", with_options(triangles, mode), triangle_schemes);
  }

  Mesh partly = with_options(grid(5, 4), Boundary::none);
  add_crease(partly, grid_row(5, 0, 0, 5), 10);
  add_crease(partly, grid_column(5, 0, 0, 4), 5);  // sharp, not infinitely: does not save its faces from being holes
  meshes.add_both("boundary_none_partly_sharpened", partly);
  Mesh all = with_options(grid(3, 3), Boundary::none);
  for (const Index k : {0, 3}) {
    add_crease(all, grid_row(3, k, 0, 3), 10);
    add_crease(all, grid_column(3, k, 0, 3), 10);
  }
  all.corners = {{0, 10}, {3, 1.3f}};
  meshes.add_both("boundary_none_all_sharpened", all);

  Mesh tagged = with_options(grid(5, 4), Boundary::edge_only);
  add_crease(tagged, grid_row(5, 0, 0, 5), 0.5f);  // a boundary edge is infinitely sharp all the same
  add_crease(tagged, grid_row(5, 2, 0, 5), 1.4f);
  tagged.corners = {{0, 2.7f}, {2, 0.4f}, {5, 10}, {grid_vertex(5, 0, 2), 1.2f}, {grid_vertex(5, 5, 4), 0.7f}};
  meshes.add_both("boundary_tags", tagged);
}

void add_creases(Collection& meshes) {
  for (const float sharpness : {0.3f, 1.0f, 1.5f, 2.7f, 9.9f, 10.0f}) {
    Mesh ring = torus(5, 4);
    add_crease(ring, torus_ring(5, 4, 1), sharpness);
    meshes.add_both("crease_ring_" + digits(sharpness), ring);
  }
  Mesh crossing = torus(5, 4);
  add_crease(crossing, torus_ring(5, 4, 0), 10);
  add_crease(crossing, tube_ring(4, 0), 1.6f);
  add_crease(crossing, tube_ring(4, 2), 10);
  meshes.add_both("crease_rings_crossing", crossing);

  // Chains across the mesh, from boundary to boundary.
  const std::vector<float> mixed{0.3f, 1, 1.5f, 2.7f, 4.2f, 9.9f, 10};
  Mesh chain = grid(7, 4);
  add_crease(chain, grid_row(7, 2, 0, 7), mixed);
  meshes.add_both("chain_uniform", chain);
  meshes.add_both("chain_chaikin", chaikin(chain));

  Mesh infinite = grid(6, 4);
  add_crease(infinite, grid_row(6, 2, 0, 6), {2.7f, 1.5f, 10, 10, 0.6f, 3.1f});
  meshes.add_both("chain_meets_infinite_uniform", infinite);
  meshes.add_both("chain_meets_infinite_chaikin", chaikin(infinite));

  Mesh decaying = grid(6, 5);
  add_crease(decaying, grid_column(6, 3, 0, 4), {2.7f, 1.5f, 0.6f, 0.2f});  // starts at the boundary, fades out
  meshes.add_both("chain_fades_uniform", decaying);
  meshes.add_both("chain_fades_chaikin", chaikin(decaying));

  // Under Chaikin's rule an edge sharper than 1 can be smooth at one end after one step, or at both. OpenSubdiv then
  // blends with its sharpness as it is, a weight beyond 1.
  Mesh uneven = grid(6, 6);
  add_crease(uneven, grid_row(6, 2, 1, 5), {3.3f, 1.1f, 0.1f, 0.1f});
  add_crease(uneven, grid_row(6, 4, 1, 4), {0.1f, 1.2f, 0.1f});
  meshes.add_both("chain_uneven_uniform", uneven);
  meshes.add_both("chain_uneven_chaikin", chaikin(uneven));

  // Three and four creases at a vertex: a corner that turns into a crease, a dart, a smooth vertex.
  const std::pair<const char*, std::vector<float>> stars[] = {{"star_3", {0.9f, 1.9f, 2.9f}},
                                                              {"star_3_equal", {1.5f, 1.5f, 1.5f}},
                                                              {"star_3_infinite", {10, 10, 1.4f}},
                                                              {"star_4", {0.5f, 1.3f, 2.2f, 3.1f}},
                                                              {"star_4_pairs", {0.4f, 2.8f, 0.9f, 2.8f}},
                                                              {"star_4_infinite", {10, 0.8f, 10, 2.3f}}};
  for (const auto& [name, arms] : stars) {
    meshes.add_both(std::string(name) + "_uniform", star(arms));
    meshes.add_both(std::string(name) + "_chaikin", chaikin(star(arms)));
  }

  Mesh darts = grid(6, 6);
  add_crease(darts, grid_row(6, 1, 1, 3), 10);
  add_crease(darts, grid_row(6, 3, 2, 5), 1.5f);
  add_crease(darts, grid_row(6, 5, 2, 3), 10);  // both ends are darts
  add_crease(darts, grid_row(6, 5, 4, 5), 0.7f);
  meshes.add_both("darts", darts);
  Mesh extraordinary_darts = disjoint_union(fan(3, 4, 2), fan(7, 4, 2));
  add_crease(extraordinary_darts, {0, 1}, 10);
  add_crease(extraordinary_darts, {fan(3, 4, 2).num_vertices(), fan(3, 4, 2).num_vertices() + 1}, 1.8f);
  meshes.add("darts_extraordinary", extraordinary_darts);

  // No, one, two and three sharp spokes at every valence: smooth vertices, darts, creases and corners.
  const std::array<std::vector<float>, 2> spokes{std::vector<float>{10, 10, 10}, {1.7f, 0.6f, 0.9f}};
  for (const Index size : {4, 3})
    for (const std::vector<float>& sharpness : spokes) {
      Mesh fans;
      for (Index n = 3; n <= 8; ++n)
        for (Index count = 0; count <= 3; ++count) {
          Mesh one = fan(n, size);
          for (Index k = 0; k < count; ++k) add_crease(one, {0, 1 + (size - 2) * (k * n / 3)}, sharpness[size_t(k)]);
          fans = disjoint_union(fans, one);
        }
      meshes.add(std::string("spokes_") + (is_infinite(sharpness[0]) ? "sharp" : "semi_sharp") +
                     (size == 3 ? "_triangles" : ""),
                 fans, size == 3 ? triangle_schemes : quad_schemes);
    }

  Mesh repeated = torus(5, 4);
  add_crease(repeated, torus_ring(5, 4, 1), 3);
  add_crease(repeated, {9, 5, 1}, 0.4f);  // the last one counts, in whichever direction
  add_crease(repeated, {13, 9}, 0);       // and takes the crease back
  add_crease(repeated, tube_ring(4, 3), 25);
  repeated.corners = {{2, 3}, {2, 0.6f}, {6, 30}};
  meshes.add_both("repeated_tags", repeated);
}

void add_corners(Collection& meshes) {
  Mesh corners = grid(8, 4);
  const std::vector<float> sharpness{0.3f, 1, 1.5f, 2.7f, 9.9f, 10, 25};
  for (Index i = 0; i < 7; ++i) corners.corners.push_back({grid_vertex(8, i + 1, 1 + i % 3), sharpness[i]});
  meshes.add_both("corners", corners);

  Mesh on_crease = grid(6, 8);
  const std::array<std::array<float, 2>, 4> pairs{{{2.2f, 0.7f}, {0.7f, 2.2f}, {0.7f, 0.3f}, {10, 1.5f}}};
  for (Index k = 0; k < 4; ++k) {
    add_crease(on_crease, grid_row(6, 2 * k + 1, 0, 6), pairs[k][0]);
    on_crease.corners.push_back({grid_vertex(6, 3, 2 * k + 1), pairs[k][1]});
  }
  meshes.add_both("corner_on_crease_uniform", on_crease);
  meshes.add_both("corner_on_crease_chaikin", chaikin(on_crease));

  // The vertex and edges at it decay in the same step: one fraction from the mean of all.
  Mesh together = star({0.3f, 0.9f, 0.5f});
  together.corners = {{grid_vertex(6, 3, 3), 0.4f}, {grid_vertex(6, 4, 3), 0.8f}, {grid_vertex(6, 5, 3), 1}};
  meshes.add_both("decay_together_uniform", together);
  meshes.add_both("decay_together_chaikin", chaikin(together));
  Mesh on_dart = grid(5, 4);
  add_crease(on_dart, grid_row(5, 2, 1, 3), 2.6f);
  on_dart.corners = {{grid_vertex(5, 1, 2), 1.7f}, {grid_vertex(5, 3, 2), 3.4f}};
  meshes.add_both("corner_on_dart", on_dart);
}

void add_faces(Collection& meshes) {
  Mesh holed = cube();
  holed.holes = {2, 5};
  meshes.add_both("holes_in_cube", holed);
  Mesh creased = grid(5, 4);
  creased.holes = {0, 7, 12};
  add_crease(creased, grid_row(5, 2, 0, 5), 1.7f);
  meshes.add_both("holes_and_crease", with_options(creased, Boundary::edge_only));

  Mesh polygons = disjoint_union(polygon_ring({4, 5, 6, 7, 3, 5, 4}), prism(5));
  meshes.add("n_gons", polygons);
  add_crease(polygons, {1, 2, 3, 4}, {0.6f, 1.9f, 1.2f});
  add_crease(polygons, {0, 7}, 2.4f);
  polygons.corners = {{5, 0.7f}, {6, 10}};
  polygons.holes = {3};
  meshes.add("n_gons_tagged", chaikin(polygons));
  meshes.add("n_gon_of_300_corners", glued(polygon(300), polygon(4), {0, 299}, {0, 1}));

  const Mesh mixed = every_second_face_triangulated(grid(5, 4));
  Mesh smooth = with_options(mixed, Boundary::edge_and_corner, Creasing::uniform, Triangles::smooth);
  meshes.add("smooth_triangles", smooth);
  add_crease(smooth, grid_row(5, 1, 0, 5), {0.3f, 0.6f, 1.4f, 0.9f, 10});
  add_crease(smooth, grid_column(5, 3, 1, 4), 0.7f);
  meshes.add("smooth_triangles_creased", smooth);
  meshes.add("smooth_triangles_polygons",
             with_options(polygon_ring({3, 4, 3, 3, 6, 4}), Boundary::edge_only, Creasing::uniform, Triangles::smooth));
  meshes.add("smooth_triangles_only",
             with_options(icosahedron(), Boundary::edge_and_corner, Creasing::uniform, Triangles::smooth));
}

void add_nonmanifold_surfaces(Collection& meshes) {
  meshes.add_both("three_faces_at_an_edge", book(3));
  meshes.add_both("five_faces_at_an_edge", book(5));
  meshes.add_both("cubes_share_a_vertex", glued(cube(), cube(), {7}, {0}));
  meshes.add("tetrahedra_share_a_vertex", glued(tetrahedron(), tetrahedron(), {0}, {1}), triangle_schemes);
  meshes.add_both("cubes_share_an_edge", glued(cube(), cube(), {3, 7}, {0, 4}));
  meshes.add_both("cubes_share_a_wall", glued(cube(), cube(), {1, 3, 5, 7}, {0, 2, 4, 6}));
  meshes.add_both("bow_tie", glued(open_fan(2), open_fan(3), {0}, {0}));
  meshes.add_both("cones_share_a_tip", glued(fan(4), fan(5), {0}, {0}));
  meshes.add_both("cone_and_wing", glued(fan(4), open_fan(2), {0}, {0}));
  meshes.add_both("flipped_pair", flipped(grid(2, 1), 1));
  meshes.add_both("flipped_face", flipped(grid(3, 3), 4));
  meshes.add_both("mobius_strip", mobius_strip(7));
  meshes.add("valence_2_at_crowded_edge", fan(2, 3, 2), triangle_schemes);

  // Fins: where they stand, two non-manifold edges meet in a vertex with more faces than edges, which is then a crease
  // unless a boundary edge comes in, as it does where the fin ends.
  const Mesh ring = with_fin(torus(5, 4), torus_ring(5, 4, 1));
  meshes.add_both("fin_around_torus", ring);
  meshes.add_both("two_fins_around_torus", with_fin(ring, torus_ring(5, 4, 1), 0.5));
  meshes.add_both("fin_across_grid", with_fin(grid(4, 4), grid_row(4, 2, 0, 4)));
  meshes.add_both("fin_inside_grid", with_fin(grid(5, 4), grid_row(5, 2, 1, 4)));
  meshes.add_both("fins_crossing", with_fin(with_fin(torus(5, 4), torus_ring(5, 4, 1)), tube_ring(4, 2), 0.5));
}

void add_nonmanifold_tags(Collection& meshes) {
  Mesh fin = with_fin(torus(5, 4), torus_ring(5, 4, 1));
  add_crease(fin, {8, 9, 10}, 1.6f);  // across the fin: a corner that decays to a crease
  add_crease(fin, {4, 5}, 0.7f);
  add_crease(fin, {17, 24}, 0.5f);  // on the fin itself
  fin.corners = {{13, 0.7f}, {17, 2.3f}};
  meshes.add_both("fin_tagged_uniform", fin);
  meshes.add_both("fin_tagged_chaikin", chaikin(fin));
  meshes.add_both("fin_boundary_none", with_options(fin, Boundary::none));

  Mesh tie = glued(open_fan(3, 4, 2), open_fan(4, 4, 2), {0}, {0});
  add_crease(tie, {0, 3}, 1.3f);
  tie.corners = {{0, 0.5f}};
  meshes.add_both("bow_tie_tagged", tie);
  meshes.add_both("bow_tie_boundary_none", with_options(tie, Boundary::none));

  Mesh cubes = glued(cube(), cube(), {3, 7}, {0, 4});
  add_crease(cubes, {1, 3, 2}, 2.7f);
  add_crease(cubes, {3, 7}, 0.4f);  // non-manifold: infinitely sharp all the same
  cubes.corners = {{7, 1.2f}, {0, 1.6f}};
  meshes.add_both("cubes_share_an_edge_tagged", chaikin(cubes));
  Mesh flip = flipped(grid(4, 4), 5);
  add_crease(flip, grid_row(4, 2, 0, 4), {1.5f, 0.8f, 2.2f, 0.3f});
  flip.holes = {10};
  meshes.add_both("flipped_face_tagged", with_options(flip, Boundary::edge_only));
}

void add_degenerate_faces(Collection& meshes) {
  const Mesh base = grid(3, 3);  // vertex 5 is interior
  meshes.add("degenerate_edge", with_face(base, 0, {0, 1, 5, 5, 4}));
  meshes.add("degenerate_edge_in_quad", with_face(base, 0, {0, 1, 5, 5}));
  meshes.add("degenerate_edge_at_boundary", with_face(base, 0, {0, 1, 1, 5, 4}));
  meshes.add("degenerate_edges_three", with_face(base, 4, {5, 6, 10, 10, 10, 10, 9}));
  const Mesh more = with_points(base, {{0.4, 0.6, 0.3}, {0.7, 0.4, -0.2}});
  meshes.add("spike_in_face", with_face(more, 0, {0, 1, 5, 16, 5, 4}));
  meshes.add("lobe_in_face", with_face(more, 0, {0, 1, 5, 16, 17, 5, 4}));
  meshes.add("flat_quad",
             make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.3}, {2, 0, 0.5}}, {{0, 1, 2, 3}, {1, 4, 2, 4}}));
  meshes.add("quad_visits_a_vertex_twice",
             make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.3}, {2, 0, 0.5}}, {{0, 1, 2, 3}, {1, 4, 1, 2}}));
  const Mesh triangles = triangle_grid(3, 3), two_points = make_mesh({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}});
  meshes.add("degenerate_triangle", glued(triangles, two_points, {5, 6}, {0, 1}), triangle_schemes);
  meshes.add("triangle_visits_a_vertex_twice", with_face(triangles, 8, {5, 10, 5}), triangle_schemes);
  meshes.add("triangle_at_one_vertex", with_face(triangles, 8, {5, 5, 5}), triangle_schemes);

  Mesh isolated = disjoint_union(make_mesh({{3, 1, 4}}, {}), with_points(grid(3, 2), {{1, 5, 9}}));
  isolated.corners = {{0, 1.5f}};
  meshes.add_both("isolated_vertices", isolated);
}

std::vector<NamedMesh> made_tagged_meshes() {
  Collection meshes;
  add_smooth(meshes);
  add_boundaries(meshes);
  add_creases(meshes);
  add_corners(meshes);
  add_faces(meshes);
  add_nonmanifold_surfaces(meshes);
  add_nonmanifold_tags(meshes);
  add_degenerate_faces(meshes);
  Mesh triangle_dart = fan(3, 3, 2);  // a single mode is odd there
  add_crease(triangle_dart, {0, 1}, 10);
  meshes.add("dart_of_three_triangles", triangle_dart, triangle_schemes);
  return meshes.take();
}

}  // namespace

std::vector<NamedMesh> tagged_meshes() {
  static const std::vector<NamedMesh> all = made_tagged_meshes();  // every process of a test asks more than once
  return all;
}

}  // namespace sublimit::testing

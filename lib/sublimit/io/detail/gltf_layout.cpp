// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_layout.h"

#include <tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "sublimit/io/detail/face_triangles.h"

namespace sublimit {
namespace {

/// What positions are seen from: of points far from the origin their middle, as floats would leave few digits.
Eigen::RowVector3d origin_of(const Eigen::RowVector3d& low, const Eigen::RowVector3d& high) {
  constexpr double far = 16;  // sizes of the mesh: four bits less
  const Eigen::RowVector3d middle = low / 2 + high / 2;
  return middle.norm() > far * (high - low).norm() ? middle : Eigen::RowVector3d::Zero();
}

std::uint64_t hash_of(const std::array<float, 3>& point) {
  std::uint64_t hash = 0;
  for (const float x : point) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return hash;
}

Index name_of_face(const Mesh::FaceNames& names, std::size_t face) {
  return names.of_face.empty() ? -1 : names.of_face[face];
}

}  // namespace

std::array<float, 3> GltfLayout::position(const GltfNode& node, const Points& positions, Index source) {
  std::array<float, 3> point{};
  for (Eigen::Index k = 0; k < 3; ++k)
    point[static_cast<std::size_t>(k)] = static_cast<float>(positions(source, k) - node.origin[k]);
  return point;
}

GltfLayout::GltfLayout(const Mesh& mesh) : mesh_(mesh) {
  if (!mesh.face_varying.empty()) channel_ = mesh.face_varying.data();
  has_polygons_ = std::ranges::any_of(mesh.face_sizes, [](Index size) { return size != 3; });
  firsts_.reserve(mesh.face_sizes.size());
  std::size_t first = 0;
  for (const Index size : mesh.face_sizes) firsts_.push_back(std::exchange(first, first + std::size_t(size)));
  split();
  divide();
  number_vertices();
  find_origins();
  if (is_shared_) needs_numbers_ = true;
  if (!needs_numbers_) find_equal_vertices();
}

void GltfLayout::split() {
  if (channel_ || !mesh_.face_normals.empty()) {
    SplitVertices split = split_vertices(mesh_, channel_);
    vertices_ = std::move(split.vertices);
    corners_ = std::move(split.corners);
    return;
  }
  vertices_.reserve(static_cast<std::size_t>(mesh_.num_vertices()));
  for (Index v = 0; v < mesh_.num_vertices(); ++v) vertices_.push_back({v, -1, -1, -1, -1});
  corners_ = mesh_.face_vertices;
}

void GltfLayout::divide() {
  std::map<std::pair<Index, Index>, std::size_t> primitive_of;  // object and material
  std::map<Index, std::size_t> node_of;
  struct Faces {
    std::size_t node, primitive;
    std::vector<Index> faces = {};
  };
  std::vector<Faces> all;
  for (std::size_t f = 0; f < mesh_.face_sizes.size(); ++f) {
    const Index object = name_of_face(mesh_.objects, f), material = name_of_face(mesh_.materials, f);
    const auto [at, is_new] = primitive_of.emplace(std::pair(object, material), all.size());
    if (is_new) {
      const auto [node, is_new_node] = node_of.emplace(object, nodes_.size());
      if (is_new_node) nodes_.push_back({.object = object});
      GltfNode& found = nodes_[node->second];
      all.push_back({node->second, found.primitives.size()});
      found.primitives.push_back({.material = material});
    }
    all[at->second].faces.push_back(static_cast<Index>(f));
  }
  for (const Faces& one : all) add_triangles(nodes_[one.node].primitives[one.primitive], one.faces);
}

/// Adds the triangles of faces, as vertices of the layout.
void GltfLayout::add_triangles(GltfPrimitive& primitive, std::span<const Index> faces) {
  std::vector<Index>& corners = primitive.corners;
  FaceTriangles triangles;
  Index last = -1;  // around which the last triangle is
  for (const Index f : faces) {
    const std::size_t first = firsts_[static_cast<std::size_t>(f)];
    const std::span<const Index> vertices(mesh_.face_vertices.data() + first,
                                          static_cast<std::size_t>(mesh_.face_sizes[static_cast<std::size_t>(f)]));
    const auto vertex_at = [&](Index corner) { return corners_[first + static_cast<std::size_t>(corner)]; };
    if (!has_polygons_) {
      for (Index i = 0; i < 3; ++i) corners.push_back(vertex_at(i));
      continue;
    }
    const auto cut =
        triangles.cut(mesh_.positions, vertices, last < 0 ? -1 : vertices_[static_cast<std::size_t>(last)].source);
    const bool is_one = triangles.is_fan() && vertex_at(cut[0][0]) != last;
    for (FaceTriangles::Corners one : cut) {
      // Triangles that are not of one fan begin with different vertices.
      if (!is_one && vertex_at(one[0]) == last) std::rotate(one.begin(), one.begin() + 1, one.end());
      for (const Index corner : one) corners.push_back(vertex_at(corner));
      if (!is_one) last = vertex_at(one[0]);
    }
    if (is_one) last = vertex_at(cut[0][0]);
  }
}

/// Gives each node the vertices that its triangles have; a node alone has all.
void GltfLayout::number_vertices() {
  if (nodes_.size() == 1) {
    nodes_[0].vertices.resize(vertices_.size());
    std::iota(nodes_[0].vertices.begin(), nodes_[0].vertices.end(), Index{0});
    return;
  }
  std::vector<Index> number(vertices_.size(), -1);
  std::vector<bool> is_taken(static_cast<std::size_t>(mesh_.num_vertices()), false);  // by the nodes before
  for (GltfNode& node : nodes_) {
    for (const GltfPrimitive& primitive : node.primitives)
      for (const Index v : primitive.corners)
        if (std::exchange(number[static_cast<std::size_t>(v)], 0) < 0) node.vertices.push_back(v);
    std::ranges::sort(node.vertices);
    for (std::size_t i = 0; i < node.vertices.size(); ++i)
      number[static_cast<std::size_t>(node.vertices[i])] = static_cast<Index>(i);
    for (GltfPrimitive& primitive : node.primitives)
      for (Index& v : primitive.corners) v = number[static_cast<std::size_t>(v)];
    for (const Index v : node.vertices) {
      number[static_cast<std::size_t>(v)] = -1;
      is_shared_ = is_shared_ || is_taken[static_cast<std::size_t>(vertices_[static_cast<std::size_t>(v)].source)];
    }
    for (const Index v : node.vertices)
      is_taken[static_cast<std::size_t>(vertices_[static_cast<std::size_t>(v)].source)] = true;
  }
}

void GltfLayout::find_origins() {
  // Vertices of several nodes are the same numbers in all of them, so they have one origin.
  if (is_shared_ || nodes_.size() == 1) {
    const Eigen::RowVector3d origin =
        origin_of(mesh_.positions.colwise().minCoeff(), mesh_.positions.colwise().maxCoeff());
    for (GltfNode& node : nodes_) node.origin = origin;
    return;
  }
  for (GltfNode& node : nodes_) {
    const auto point = [&](Index v) {
      return Eigen::RowVector3d(mesh_.positions.row(vertices_[static_cast<std::size_t>(v)].source));
    };
    Eigen::RowVector3d low = point(node.vertices[0]), high = low;
    for (const Index v : node.vertices) {
      low = low.cwiseMin(point(v));
      high = high.cwiseMax(point(v));
    }
    node.origin = origin_of(low, high);
  }
}

void GltfLayout::find_equal_vertices() {
  for (const GltfNode& node : nodes_) {
    std::vector<std::uint64_t> hashes;
    hashes.reserve(node.vertices.size());
    Index before = -1;
    for (const Index v : node.vertices) {
      const Index source = vertices_[static_cast<std::size_t>(v)].source;
      if (std::exchange(before, source) == source) continue;
      hashes.push_back(hash_of(position(node, mesh_.positions, source)));
    }
    tbb::parallel_sort(hashes.begin(), hashes.end());
    if (std::ranges::adjacent_find(hashes) != hashes.end()) needs_numbers_ = true;
  }
}

Eigen::RowVector3d GltfLayout::normal(Index vertex) const {
  const SplitVertices::Vertex& v = vertices_[static_cast<std::size_t>(vertex)];
  const bool is_per_corner = !mesh_.face_normals.empty();
  Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
  if (!is_per_corner || v.normal >= 0) normal = mesh_.normals.row(is_per_corner ? v.normal : v.source);
  constexpr double unit = 1e-3;  // less than readers mind; numbers that are unit already stay
  if (std::abs(normal.norm() - 1) <= unit) return normal;
  normal = normal.stableNormalized();
  if (normal.allFinite() && normal.norm() > 0.5) return normal;
  if (v.corner >= 0) {  // that of its face
    const auto face = std::ranges::upper_bound(firsts_, static_cast<std::size_t>(v.corner)) - firsts_.begin() - 1;
    const auto corner = [&](std::size_t i) {
      return Eigen::Vector3d(
          mesh_.positions.row(mesh_.face_vertices[firsts_[static_cast<std::size_t>(face)] + i]).transpose());
    };
    const Eigen::Vector3d flat =
        (corner(1) - corner(0)).stableNormalized().cross((corner(2) - corner(0)).stableNormalized()).stableNormalized();
    if (flat.allFinite() && flat.norm() > 0.5) return flat.transpose();
  }
  return Eigen::RowVector3d::UnitZ();
}

std::vector<Index> gltf_vertex_order(const Mesh& mesh) {
  std::vector<Index> order;
  const GltfLayout layout(mesh);
  for (const GltfNode& node : layout.nodes()) order.insert(order.end(), node.vertices.begin(), node.vertices.end());
  return order;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// What of a mesh is where in a glTF file: a node for each object, a primitive for each material of its faces, vertices
// split where their corners differ, polygons cut into triangles.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sublimit/io/detail/split_mesh.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Triangles of one material.
struct GltfPrimitive {
  Index material = -1;              ///< number in the mesh's names, -1 for none
  std::vector<Index> corners = {};  ///< vertices of the node, three for each triangle
};

/// Faces of one object.
struct GltfNode {
  Index object = -1;                 ///< number in the mesh's names, -1 for none
  std::vector<Index> vertices = {};  ///< of the layout
  std::vector<GltfPrimitive> primitives = {};
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();  ///< its translation
};

/// Parts of a mesh for a file. The mesh must outlive it.
class GltfLayout {
 public:
  /// @pre  `check_output` accepts the mesh
  explicit GltfLayout(const Mesh& mesh);
  explicit GltfLayout(const Mesh&& mesh) = delete;

  /// Returns the nodes, in the order in which faces first have their objects.
  const std::vector<GltfNode>& nodes() const { return nodes_; }
  /// Returns the vertices of the mesh that the file has, split where corners differ.
  const std::vector<SplitVertices::Vertex>& vertices() const { return vertices_; }
  /// Returns the texture coordinates of corners; null if there are none.
  const Mesh::FaceVarying* channel() const { return channel_; }
  /// Returns true if triangles are parts of polygons: those of a polygon begin with one corner, those of the next one
  /// with another.
  bool has_polygons() const { return has_polygons_; }
  /// Returns true if equal coordinates do not tell which vertices are one.
  bool needs_numbers() const { return needs_numbers_; }
  /// Returns a unit normal of a vertex.
  /// @pre  the mesh has normals
  Eigen::RowVector3d normal(Index vertex) const;
  /// Returns the coordinates of a node's vertex as the file has them.
  static std::array<float, 3> position(const GltfNode& node, const Points& positions, Index source);

 private:
  void split();
  void divide();
  void add_triangles(GltfPrimitive& primitive, std::span<const Index> faces);
  void number_vertices();
  void find_origins();
  void find_equal_vertices();

  const Mesh& mesh_;
  const Mesh::FaceVarying* channel_ = nullptr;
  std::vector<SplitVertices::Vertex> vertices_;
  std::vector<Index> corners_;       // vertex of each corner
  std::vector<std::size_t> firsts_;  // first corner of each face
  std::vector<GltfNode> nodes_;
  bool has_polygons_ = false, is_shared_ = false, needs_numbers_ = false;
};

/// Returns the vertices of a mesh in the order in which a glTF file has them, as numbers in `split_vertices` of the
/// same mesh.
std::vector<Index> gltf_vertex_order(const Mesh& mesh);

}  // namespace sublimit

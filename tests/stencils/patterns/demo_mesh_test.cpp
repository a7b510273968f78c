// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/demo_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using DirectedEdge = std::pair<Index, Index>;

/// What the tests ask of a mesh, found without the library's own Topology.
struct Census {
  std::vector<std::vector<Index>> faces;
  std::map<DirectedEdge, int> face_of;              // the face on the left of a directed edge
  std::vector<std::map<Index, Index>> next_around;  // per vertex: from the head of one edge to that of the next
  bool edge_used_twice = false;                     // in the same direction

  explicit Census(const Mesh& mesh) : next_around(mesh.num_vertices()) {
    auto corner = mesh.face_vertices.begin();
    for (const Index size : mesh.face_sizes) {
      faces.emplace_back(corner, corner + size);
      corner += size;
      const std::vector<Index>& face = faces.back();
      for (Index i = 0; i < size; ++i) {
        const Index at = face[i], next = face[(i + 1) % size], previous = face[(i + size - 1) % size];
        edge_used_twice |= !face_of.insert({{at, next}, static_cast<int>(faces.size()) - 1}).second;
        next_around[at][next] = previous;
      }
    }
  }
  bool on_boundary(const DirectedEdge& edge) const { return !face_of.contains({edge.second, edge.first}); }
  std::set<DirectedEdge> edges() const {
    std::set<DirectedEdge> result;
    for (const auto& [edge, face] : face_of) result.insert(std::minmax(edge.first, edge.second));
    return result;
  }
  /// Edges around the vertex, negative on the boundary.
  int valence(Index vertex) const {
    std::set<Index> neighbors;
    bool boundary = false;
    for (const auto& [from, to] : next_around[vertex]) {
      neighbors.insert({from, to});
      boundary |= on_boundary({vertex, from});
    }
    return static_cast<int>(boundary ? -neighbors.size() : neighbors.size());
  }
};

Vector3d position(const Mesh& mesh, Index vertex) { return mesh.positions.row(vertex); }

std::map<Index, int> creases_at(const Mesh& mesh) {
  std::map<Index, int> count;
  for (const Mesh::Crease& crease : mesh.creases) ++count[crease.tail], ++count[crease.head];
  return count;
}

TEST(DemoMesh, IsAnOrientedManifold) {
  const Mesh mesh = demo_mesh();
  const Census census(mesh);
  EXPECT_FALSE(census.edge_used_twice);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const std::map<Index, Index>& next = census.next_around[v];
    ASSERT_FALSE(next.empty()) << "vertex " << v << " has no face";
    // One fan: from its first edge (the one no face leads to, if there is one) every face is met.
    Index start = next.begin()->first;
    for (const auto& [from, to] : next) {
      if (census.on_boundary({v, from})) start = from;
    }
    std::size_t met = 0;
    for (Index at = start; next.contains(at) && met < next.size() + 1;) {
      at = next.at(at);
      ++met;
      if (at == start) break;
    }
    EXPECT_EQ(met, next.size()) << "vertex " << v;
  }
}

TEST(DemoMesh, HasOneHandleAndOneBoundaryLoop) {
  const Mesh mesh = demo_mesh();
  const Census census(mesh);
  const int euler = mesh.num_vertices() - static_cast<int>(census.edges().size()) + mesh.num_faces();
  EXPECT_EQ(euler, 2 - 2 * 1 - 1);
  std::map<Index, Index> boundary;
  for (const auto& [edge, face] : census.face_of) {
    if (census.on_boundary(edge)) boundary[edge.first] = edge.second;
  }
  ASSERT_FALSE(boundary.empty());
  const Index start = boundary.begin()->first;
  std::size_t length = 1;
  for (Index at = boundary[start]; at != start && length <= boundary.size(); at = boundary[at]) ++length;
  EXPECT_EQ(length, boundary.size());
}

TEST(DemoMesh, HasExtraordinaryVerticesOfThreeKinds) {
  const Mesh mesh = demo_mesh();
  const Census census(mesh);
  std::map<int, int> count;
  for (Index v = 0; v < mesh.num_vertices(); ++v) ++count[census.valence(v)];
  EXPECT_GT(count[3], 0);
  EXPECT_GT(count[5], 0);
  EXPECT_GT(count[6], 0);
  EXPECT_GT(2 * count[4], mesh.num_vertices());  // most are ordinary
}

TEST(DemoMesh, HasTrianglesQuadsPentagonsAndAHexagon) {
  const Mesh mesh = demo_mesh();
  EXPECT_GE(mesh.num_faces(), 150);
  EXPECT_LE(mesh.num_faces(), 500);
  for (const Index size : {3, 4, 5, 6}) {
    EXPECT_GT(std::count(mesh.face_sizes.begin(), mesh.face_sizes.end(), size), 0) << size;
  }
  EXPECT_GT(2 * std::count(mesh.face_sizes.begin(), mesh.face_sizes.end(), 4), mesh.num_faces());
}

TEST(DemoMesh, HasSharpSemiSharpAndEndingCreasesAndACorner) {
  const Mesh mesh = demo_mesh();
  const std::set<DirectedEdge> edges = Census(mesh).edges();
  std::set<DirectedEdge> creased;
  std::set<float> sharpness;
  for (const Mesh::Crease& crease : mesh.creases) {
    const DirectedEdge edge = std::minmax(crease.tail, crease.head);
    EXPECT_TRUE(edges.contains(edge)) << crease.tail << " " << crease.head;
    EXPECT_TRUE(creased.insert(edge).second) << "twice: " << crease.tail << " " << crease.head;
    sharpness.insert(crease.sharpness);
  }
  EXPECT_EQ(sharpness, (std::set<float>{2.5F, 10}));
  const std::map<Index, int> count = creases_at(mesh);
  const auto darts = std::count_if(count.begin(), count.end(), [](const auto& entry) { return entry.second == 1; });
  EXPECT_EQ(darts, 4);
  EXPECT_EQ(mesh.corners.size(), 1u);
  EXPECT_FALSE(mesh.boundary || mesh.creasing || mesh.triangles);
  EXPECT_TRUE(mesh.holes.empty() && mesh.warnings.empty());
}

TEST(DemoMesh, HasNoDegenerateOrFoldedFace) {
  const Mesh mesh = demo_mesh();
  double volume = 0;
  for (const std::vector<Index>& face : Census(mesh).faces) {
    const Index size = static_cast<Index>(face.size());
    const auto at = [&](Index i) { return position(mesh, face[(i + size) % size]); };
    Vector3d area = Vector3d::Zero();
    for (Index i = 0; i < size; ++i) area += at(i).cross(at(i + 1)) / 2;
    EXPECT_GT(area.norm(), 1e-3);  // the whole is three units high
    for (Index i = 0; i < size; ++i) {
      // Every corner turns the way its face does.
      const Vector3d turn = (at(i) - at(i - 1)).cross(at(i + 1) - at(i));
      EXPECT_GT(turn.normalized().dot(area.normalized()), .5)
          << "corner " << i << " of a face at " << at(0).transpose();
      volume += at(0).dot(at(i).cross(at(i + 1))) / 6;
    }
  }
  EXPECT_GT(volume, 0);  // counter-clockwise seen from outside
}

TEST(DemoMesh, HasNoTwoVerticesAtOnePlace) {
  const Mesh mesh = demo_mesh();
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    for (Index w = 0; w < v; ++w) EXPECT_GT((position(mesh, v) - position(mesh, w)).norm(), .01) << v << " " << w;
  }
}

TEST(DemoMesh, IsItsOwnMirrorImageAndStandsOnTheGround) {
  const Mesh mesh = demo_mesh();
  const auto key = [](double x, double y, double z) {
    const auto ticks = [](double value) { return std::lround(1e4 * value); };  // its own resolution
    return std::vector<long>{ticks(x), ticks(y), ticks(z)};
  };
  std::set<std::vector<long>> places;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3d p = position(mesh, v);
    places.insert(key(p.x(), p.y(), p.z()));
  }
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3d p = position(mesh, v);
    EXPECT_TRUE(places.contains(key(p.x(), p.y(), -p.z()))) << p.transpose();
  }
  EXPECT_EQ(mesh.positions.col(1).minCoeff(), 0);
}

TEST(DemoMesh, IsTheSameEveryTime) {
  const Mesh a = demo_mesh(), b = demo_mesh();
  EXPECT_TRUE((a.positions.array() == b.positions.array()).all());
  EXPECT_EQ(a.face_vertices, b.face_vertices);
}

}  // namespace
}  // namespace sublimit::testing

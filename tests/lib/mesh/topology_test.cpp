// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/topology.h"

#include <gtest/gtest.h>

#include <set>

#include "meshes/broken_topology.h"
#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/splits/split.h"

namespace sublimit::testing {
namespace {

TEST(Topology, IsConsistentOnEveryTestMeshAndItsRefinements) {
  for (const NamedMesh& named : tagged_meshes()) {
    const Topology t(view(named.mesh));
    EXPECT_EQ(broken(t), "") << named.name;
    const Refinement quads = refine(t, Split::pqq);
    EXPECT_EQ(broken(quads.topology), "") << named.name;
    EXPECT_EQ(broken(refine(quads.topology, Split::pqq).topology), "") << named.name;
    if (t.uniform_face_size() == 3) {
      EXPECT_EQ(broken(refine(t, Split::ptq).topology), "") << named.name;
    }
  }
}

// Every edge of a closed mesh has two ends and two faces, so the 4 - valence of the vertices and the 4 - corners of the
// faces sum to 4 (V - E + F), and of triangles the 6 - valence to 6 (V - E + F). A net without extraordinary places is
// therefore a torus (or open): on a sphere they sum to that of eight vertices of valence 3, or twelve of valence 5.
TEST(Topology, ExtraordinaryPlacesOfClosedMeshesSumToTheEulerCharacteristic) {
  const std::pair<Mesh, Index> closed[] = {{cube(), 2},
                                           {prism(5), 2},
                                           {pole(5), 2},
                                           {quads_from_triangles(icosahedron()), 2},
                                           {tetrahedron(), 2},
                                           {octahedron(), 2},
                                           {icosahedron(), 2},
                                           {torus(4, 5), 0},
                                           {triangle_torus(4, 5), 0}};
  for (const auto& [mesh, euler] : closed) {
    const Topology t(view(mesh));
    SCOPED_TRACE("V = " + std::to_string(t.num_vertices()) + ", F = " + std::to_string(t.num_faces()));
    EXPECT_EQ(euler_characteristic(t), euler);
    Index quads = 0, triangles = 0;
    for (Index v = 0; v < t.num_vertices(); ++v) {
      quads += 4 - t.num_faces(Vertex{v});
      triangles += 6 - t.num_faces(Vertex{v});
    }
    for (Index f = 0; f < t.num_faces(); ++f) quads += 4 - t.size(Face{f});
    EXPECT_EQ(quads, 4 * euler);
    if (t.uniform_face_size() == 3) {
      EXPECT_EQ(triangles, 6 * euler);
    }
  }
}

// V' = V + F + E, F' = corners, E' = 2 E + corners; triangles: V' = V + E, F' = 4 F, E' = 2 E + 3 F.
TEST(Split, CountsAreTheSplits) {
  for (const NamedMesh& named : tagged_meshes()) {
    const Topology t(view(named.mesh));
    const Topology q = refine(t, Split::pqq).topology;
    EXPECT_EQ(q.num_vertices(), t.num_vertices() + t.num_faces() + t.num_edges());
    EXPECT_EQ(q.num_faces(), t.num_half_edges());
    EXPECT_EQ(q.num_edges(), 2 * t.num_edges() + t.num_half_edges());
    if (t.uniform_face_size() != 3) continue;
    const Topology r = refine(t, Split::ptq).topology;
    EXPECT_EQ(r.num_vertices(), t.num_vertices() + t.num_edges());
    EXPECT_EQ(r.num_faces(), 4 * t.num_faces());
    EXPECT_EQ(r.num_edges(), 2 * t.num_edges() + 3 * t.num_faces());
  }
}

// Built from the children's faces alone, a manifold mesh has the connectivity that the split made by arithmetic.
TEST(Split, AgreesWithTopologyBuiltFromFaces) {
  for (const Mesh& mesh : {torus(4, 5), grid(3, 4), prism(7), icosahedron(), triangle_grid(4, 3)}) {
    const Topology t(view(mesh));
    for (const Split split : {Split::pqq, Split::ptq}) {
      if (split == Split::ptq && t.uniform_face_size() != 3) continue;
      const Topology child = refine(t, split).topology;
      std::vector<Index> corners, sizes;
      for (Index f = 0; f < child.num_faces(); ++f) {
        const auto vertices = child.vertices(Face{f});
        corners.insert(corners.end(), vertices.begin(), vertices.end());
        sizes.push_back(child.size(Face{f}));
      }
      const Topology built({.num_vertices = child.num_vertices(), .face_vertices = corners, .face_sizes = sizes});
      ASSERT_EQ(built.num_edges(), child.num_edges());
      for (Index h = 0; h < child.num_half_edges(); ++h) {
        EXPECT_EQ(built.twin(HalfEdge{h}), child.twin(HalfEdge{h}));
        EXPECT_EQ(built.edge(HalfEdge{h}), child.edge(HalfEdge{h}));
      }
    }
  }
}

TEST(Topology, FaultsAreAllListed) {
  using Kind = Topology::Fault::Kind;
  const auto kinds = [](Index vertices, const std::vector<Index>& sizes, const std::vector<Index>& corners) {
    const Topology t({.num_vertices = vertices, .face_vertices = corners, .face_sizes = sizes});
    std::multiset<Kind> result;
    for (const Topology::Fault& fault : t.faults()) result.insert(fault.kind);
    return result;
  };
  EXPECT_EQ(kinds(4, {4}, {0, 1, 2, 3}), std::multiset<Kind>{});
  EXPECT_EQ(kinds(5, {4}, {0, 1, 2, 3}), std::multiset<Kind>{Kind::isolated_vertex});
  EXPECT_EQ(kinds(5, {3, 3, 3}, {0, 1, 2, 1, 0, 3, 0, 1, 4}).count(Kind::crowded_edge), 1u);
  EXPECT_EQ(kinds(4, {3, 3}, {0, 1, 2, 0, 1, 3}), std::multiset<Kind>{Kind::inconsistent_winding});
  EXPECT_EQ(kinds(5, {3, 3}, {0, 1, 2, 0, 3, 4}), std::multiset<Kind>{Kind::several_fans});
  EXPECT_EQ(kinds(3, {4}, {0, 0, 1, 2}).count(Kind::degenerate_edge), 1u);
  EXPECT_EQ(kinds(5, {6}, {0, 1, 2, 0, 3, 4}).count(Kind::repeated_vertex), 1u);
}

TEST(Topology, RejectsWhatNoSchemeCouldTake) {
  const auto build = [](Index vertices, std::vector<Index> sizes, std::vector<Index> corners) {
    Topology({.num_vertices = vertices, .face_vertices = corners, .face_sizes = sizes});
  };
  EXPECT_THROW(build(3, {2}, {0, 1}), InvalidMesh);
  EXPECT_THROW(build(3, {3}, {0, 1, 3}), InvalidMesh);
  EXPECT_THROW(build(3, {3}, {0, 1, -1}), InvalidMesh);
  EXPECT_THROW(build(3, {4}, {0, 1, 2}), InvalidMesh);
  EXPECT_THROW(refine(Topology(view(cube())), Split::ptq), UnsupportedTopology);
}

TEST(Sharpness, TagsThatPointNowhereAreErrors) {
  const Topology t(view(cube()));
  Mesh tags;
  tags.creases = {{0, 7, 1}};
  EXPECT_THROW(initial_sharpness(t, tags, Boundary::edge_only, Creasing::uniform), InvalidMesh);
  tags.creases = {{0, 1, -1}};
  EXPECT_THROW(initial_sharpness(t, tags, Boundary::edge_only, Creasing::uniform), InvalidMesh);
  tags.creases = {};
  tags.corners = {{8, 1}};
  EXPECT_THROW(initial_sharpness(t, tags, Boundary::edge_only, Creasing::uniform), InvalidMesh);
  tags.corners = {};
  tags.holes = {6};
  EXPECT_THROW(initial_holes(t, tags, Boundary::edge_only), InvalidMesh);
}

// DeRose, Kass, Truong 1998, Chaikin: 3/4 of the edge, 1/4 of the mean of the other semi-sharp ones, less 1.
TEST(Sharpness, ChaikinDecayIsAWeightedMean) {
  const VertexSharpness around(0, {3, 1, infinite_sharpness, 0}, Creasing::chaikin);
  EXPECT_EQ(around.child_edges, (std::vector<float>{1.5f, 0.5f, infinite_sharpness, 0}));
  EXPECT_EQ(VertexSharpness(0, {3, 0}, Creasing::chaikin).child_edges, (std::vector<float>{2, 0}));
  EXPECT_EQ(VertexSharpness(0, {3, 1, 12, 0.5f}, Creasing::uniform).child_edges,
            (std::vector<float>{2, 0, infinite_sharpness, 0}));
}

TEST(Sharpness, ParentsRuleCountsByTheMeanOfWhatDecays) {
  EXPECT_EQ(VertexSharpness(0, {0.25f, 0.75f, 0, 0}, Creasing::uniform).parent_weight(), 0.5f);
  EXPECT_EQ(VertexSharpness(1, {0.5f, 2, 0, 0}, Creasing::uniform).parent_weight(), 0.75f);
  EXPECT_EQ(VertexSharpness(0, {2, 2, 0, 0}, Creasing::uniform).parent_weight(), 0);
}

}  // namespace
}  // namespace sublimit::testing

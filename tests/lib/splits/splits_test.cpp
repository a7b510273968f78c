// SPDX-License-Identifier: Apache-2.0
// What every split makes of a mesh with V vertices, E edges, F faces, H corners of faces and B border edges, and the
// quads of the split that only Kobbelt's option quads=edges uses.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "meshes/broken_topology.h"
#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> all{cube(),
                                     prism(5),
                                     torus(4, 5),
                                     pole(5),
                                     grid(3, 4),
                                     fan(5, 4, 2),
                                     open_fan(1),
                                     open_fan(3, 4, 2),
                                     octahedron(),
                                     icosahedron(),
                                     triangle_grid(3, 3),
                                     fan(7, 3, 2),
                                     open_fan(4, 3, 2),
                                     polygon_ring({3, 5, 4, 6}),
                                     triangle_torus(4, 5)};
  return all;
}

bool on_border(const Topology& t, Index v) {
  const HalfEdge h = t.outgoing(Vertex{v});
  return exists(h) && !exists(t.twin(h));
}

TEST(Splits, MakeTheCountsOfTheirKind) {
  for (const Mesh& mesh : meshes()) {
    const Topology t{view(mesh)};
    const Index V = t.num_vertices(), E = t.num_edges(), F = t.num_faces(), H = t.num_half_edges(), B = 2 * E - H;
    Index tips = 0, cut = 0;  // border vertices of a single face; faces with a single border edge
    for (Index v = 0; v < V; ++v) tips += on_border(t, v) && t.num_faces(Vertex{v}) == 1;
    for (Index f = 0; f < F; ++f) {
      Index borders = 0;
      for (Index i = 0; i < t.size(Face{f}); ++i) borders += !exists(t.twin(t.corner(Face{f}, i)));
      cut += borders == 1;
    }
    struct Counts {
      Split split;
      int level;
      Index vertices, faces, borders;
    };
    std::vector<Counts> all{{Split::pqq, 0, V + E + F, H, 2 * B},
                            {Split::dqq, 0, H + 2 * B, F + E + V, 2 * B},
                            {Split::mid_edge, 0, E + B, F + V, 2 * B},
                            {Split::mid_edge, 1, E, F + V - tips, B},  // the border is cut off
                            {Split::dual, 0, F + B, V, B},
                            {Split::quads, 0, V + F + B, E, 2 * B},
                            {Split::keep, 0, V, F, B}};
    if (t.uniform_face_size() == 3) {
      all.push_back({Split::ptq, 0, V + E, 4 * F, 2 * B});
      all.push_back({Split::sqrt3, 0, V + F, H, B});
      all.push_back({Split::sqrt3, 1, V + F - cut + 2 * B, H + 2 * (B - cut), 3 * B});  // the border is trisected
    }
    for (const Counts& counts : all) {
      const Topology child = refine(t, counts.split, counts.level).topology;
      SCOPED_TRACE(std::string(name(counts.split)) + " of level " + std::to_string(counts.level) +
                   ", V = " + std::to_string(V));
      EXPECT_EQ(broken(child), "");
      EXPECT_EQ(child.num_vertices(), counts.vertices);
      EXPECT_EQ(child.num_faces(), counts.faces);
      EXPECT_EQ(euler_characteristic(child), euler_characteristic(t));
      EXPECT_EQ(num_borders(child), counts.borders);
      EXPECT_GE(num_child_half_edges(t, counts.split), child.num_half_edges());
    }
  }
}

// New vertices on edges are regular, so extraordinary vertices come apart and get no more. On the border that is
// valence 3 among quads and 4 among triangles; only old vertices have others, as corners of a single face have 2.
TEST(Splits, VerticesOnEdgesAreRegular) {
  for (const Mesh& mesh : meshes()) {
    const Topology t{view(mesh)};
    for (const Split split : {Split::pqq, Split::ptq}) {
      if (split == Split::ptq && t.uniform_face_size() != 3) continue;
      const Refinement r = refine(t, split);
      const Index inside = split == Split::pqq ? 4 : 6;
      EXPECT_EQ(r.from_edges, t.num_edges());
      for (Index v = 0; v < r.topology.num_vertices(); ++v)
        if (r.origin(Vertex{v}) == Refinement::Origin::edge) {
          EXPECT_EQ(r.topology.num_faces(Vertex{v}), on_border(r.topology, v) ? inside / 2 : inside);
          EXPECT_EQ(on_border(r.topology, v), t.is_boundary(Edge{r.parent(Vertex{v})}));
        }
    }
  }
}

// So that sums around vertices have the same bits whether a level is refined or written, read and refined.
TEST(Splits, PrimalFansStartWhereThoseOfTheSameFacesReadAgainDo) {
  for (const Mesh& mesh : meshes())
    for (const Split split : {Split::pqq, Split::ptq}) {
      Topology t{view(mesh)};
      if (split == Split::ptq && t.uniform_face_size() != 3) continue;
      for (int k = 0; k < 2; ++k) {
        Topology child = refine(t, split).topology;
        std::vector<Index> corners;
        for (Index f = 0; f < child.num_faces(); ++f)
          for (const Index v : child.vertices(Face{f})) corners.push_back(v);
        const Topology again{MeshView{child.num_vertices(), corners, {}, child.uniform_face_size()}};
        for (Index v = 0; v < child.num_vertices(); ++v)
          EXPECT_EQ(child.outgoing(Vertex{v}), again.outgoing(Vertex{v})) << name(split) << ", vertex " << v;
        t = std::move(child);
      }
    }
}

TEST(Splits, AFaceHasFourQuadsForEachCornerAfterTwo) {
  const Mesh mesh = polygon_ring({5, 4, 3, 6, 4});
  std::vector<Index> children(mesh.num_faces(), 0);
  for (const Index f : control_faces(refine(*find_scheme("catmull-clark"), mesh, 2))) ++children[f];
  for (Index f = 0; f < mesh.num_faces(); ++f) EXPECT_EQ(children[f], 4 * mesh.face_sizes[f]);
}

TEST(Splits, EveryFaceHasDescendants) {
  for (const Scheme<double>& scheme : all_schemes()) {
    const Mesh mesh = scheme.face_size() == 3 ? icosahedron() : cube();
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    const std::vector<Index> faces = control_faces(levels);
    EXPECT_EQ(std::ssize(faces), levels.back().topology().num_faces());
    for (Index f = 0; f < mesh.num_faces(); ++f)
      EXPECT_TRUE(std::find(faces.begin(), faces.end(), f) != faces.end()) << scheme.name;
  }
}

// A quad for each edge (a, b): a, the right face's point, b, the left face's; a border has its midpoint for the face
// that is missing.
TEST(Splits, QuadsStandOnEdges) {
  for (const Mesh& mesh : meshes()) {
    const Topology t{view(mesh)};
    const Refinement r = refine(t, Split::quads);
    EXPECT_EQ(r.topology.uniform_face_size(), 4);
    EXPECT_EQ(r.faces_from_edges, t.num_edges());
    for (Index f = 0; f < r.topology.num_faces(); ++f) {
      const auto corners = r.topology.vertices(Face{f});
      const auto origin = [&](int i) { return r.origin(Vertex{corners[i]}); };
      const auto parent = [&](int i) { return r.parent(Vertex{corners[i]}); };
      ASSERT_TRUE(origin(0) == Refinement::Origin::vertex && origin(2) == Refinement::Origin::vertex);
      ASSERT_EQ(origin(3), Refinement::Origin::face);
      HalfEdge h = t.first(Face{parent(3)});
      while (index(t.tail(h)) != parent(0) || index(t.head(h)) != parent(2)) {
        h = t.next(h);
        ASSERT_NE(h, t.first(Face{parent(3)})) << "no edge of the left face";
      }
      const HalfEdge g = t.twin(h);
      EXPECT_EQ(origin(1), exists(g) ? Refinement::Origin::face : Refinement::Origin::border);
      EXPECT_EQ(parent(1), exists(g) ? index(t.face(g)) : index(h));
    }
  }
}

// Kobbelt's preparation by this split: vertices stay, faces get their centroids, border edges their midpoints.
TEST(Splits, KobbeltCutsByEdgesAtCentroidsAndMidpoints) {
  const Scheme<double> scheme = *find_scheme("kobbelt", {{"quads", "edges"}});
  const Mesh mesh = jittered(polygon_ring({3, 5, 4, 6}));
  const Level level = refine(scheme, mesh, 1)[1];
  ASSERT_EQ(level.steps.size(), 2u);
  EXPECT_EQ(level.steps[0].split, Split::quads);
  const Topology t{view(mesh)};
  const Refinement& cut = level.steps[0];
  // The next step keeps vertices, so the first rows of S are those of the cut.
  const Points x = apply(level.S, mesh.positions);
  int borders = 0;
  for (Index v = 0; v < cut.topology.num_vertices(); ++v) {
    Eigen::RowVector3d expected = Eigen::RowVector3d::Zero();
    const Index p = cut.parent(Vertex{v});
    switch (cut.origin(Vertex{v})) {
      case Refinement::Origin::vertex:
        expected = mesh.positions.row(p);
        break;
      case Refinement::Origin::face:
        for (const Index w : t.vertices(Face{p})) expected += mesh.positions.row(w) / double(t.size(Face{p}));
        break;
      default:
        ++borders;
        expected =
            (mesh.positions.row(index(t.tail(HalfEdge{p}))) + mesh.positions.row(index(t.head(HalfEdge{p})))) / 2;
    }
    EXPECT_LE((x.row(v) - expected).norm(), rounding(8, 10)) << "vertex " << v;
  }
  EXPECT_EQ(borders, 2 * t.num_edges() - t.num_half_edges());
}

}  // namespace
}  // namespace sublimit::testing

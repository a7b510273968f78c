// SPDX-License-Identifier: Apache-2.0
// Refined meshes against OpenMesh 9, live: positions after three levels to 1e-13 of the bounding box, connectivity as
// it is.
//
// Where its rules are ours, all of them found by running it:
//   LoopT                  everywhere, borders too; Loop's weights, which are Warren's at valences 3 and 6 only
//   Sqrt3T                 everywhere, borders too
//   ModifiedButterflyT     everywhere, borders too: valences 3 and 4 by masks of their own, the mean where both ends
//   are
//                          extraordinary, border vertices regular whatever their valence, virtual vertices beyond
//                          borders
//   InterpolatingSqrt3LGT  inside and along the border curve: valence 3 by a mask of its own (4 has one, too, which is
//   the
//                          general one), the mean where several corners are extraordinary
//   CatmullClarkT          inside
//   MidpointT              inside
// Where they are not:
//   corners                border vertices of a single face are smoothed as all others are: boundary edge_only here
//   CatmullClarkT          border vertices move to (a + 4 v + b)/6, the mean of the vertex and the new points of its
//   two
//                          border edges: not the cubic B-spline's (a + 6 v + b)/8
//   InterpolatingSqrt3LGT  faces near a border, see InterpolatorySqrt3NearBorders
//   MidpointT              border vertices have no face and leave nothing
// Numbers: with traits that make points double and leave normals float, LoopT rounds positions to float; tables of
// weights end at valence 49 (modified butterfly: grow) and are read beyond without a word, so the reference enlarges
// them.
#include <gtest/gtest.h>

#include <set>

#include "meshes/irregular_meshes.h"
#include "meshes/match_meshes.h"
#include "peers/openmesh_reference.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Matching against_openmesh(const std::string& scheme, OpenMeshScheme peer, const Mesh& mesh, int levels,
                          Boundary boundary = Boundary::edge_only) {
  return match(our_mesh(scheme, mesh, levels, boundary), openmesh_refine(mesh, peer, levels));
}

class OpenMesh : public ::testing::TestWithParam<SchemeOnMesh> {};

TEST_P(OpenMesh, RefinesAsWeDo) {
  const auto& [scheme, name, mesh] = GetParam();
  const Matching m = against_openmesh(scheme, openmesh_scheme(scheme).value(), mesh, 3);
  EXPECT_EQ(m.mismatch, "");
  EXPECT_LE(m.error, reference);
}

INSTANTIATE_TEST_SUITE_P(ClosedTriangles, OpenMesh,
                         ::testing::ValuesIn(schemes_on({"loop", "sqrt3", "modified-butterfly", "interpolatory-sqrt3"},
                                                        closed_triangle_meshes())),
                         name_of_test);
INSTANTIATE_TEST_SUITE_P(ClosedPolygons, OpenMesh,
                         ::testing::ValuesIn(schemes_on({"catmull-clark", "mid-edge"}, closed_polygon_meshes())),
                         name_of_test);
INSTANTIATE_TEST_SUITE_P(Borders, OpenMesh,
                         ::testing::ValuesIn(schemes_on({"loop", "sqrt3", "modified-butterfly"},
                                                        open_triangle_meshes())),
                         name_of_test);

// A variant with other weights meets its sister where the weights coincide, and only there: the comparison sees
// weights.
TEST(OpenMeshVariants, CoincideOnRegularMeshesOnly) {
  struct Variant {
    std::string scheme;
    OpenMeshScheme sister;
    Mesh same, different;
  };
  const Mesh triangles = triangle_torus(5, 4), quads = torus(5, 4);
  for (const Variant& v : {Variant{"loop-warren", OpenMeshScheme::loop, triangles, octahedron()},
                           Variant{"loop-warren", OpenMeshScheme::loop, tetrahedron(), icosahedron()},
                           Variant{"butterfly", OpenMeshScheme::modified_butterfly, triangles, icosahedron()},
                           Variant{"averaging", OpenMeshScheme::catmull_clark, quads, prism(5)},
                           Variant{"mid-edge-habib-warren", OpenMeshScheme::midpoint, quads, prism(5)}}) {
    SCOPED_TRACE(v.scheme);
    EXPECT_LE(against_openmesh(v.scheme, v.sister, jittered(v.same), 3).error, reference);
    const Matching m = against_openmesh(v.scheme, v.sister, jittered(v.different), 3);
    EXPECT_EQ(m.mismatch, "");
    EXPECT_GT(m.error, 1e-3);
  }
}

/// The other ends of the border edges at every vertex.
std::vector<std::vector<Index>> along_border(const Topology& t) {
  std::vector<std::vector<Index>> ends(t.num_vertices());
  for (Index e = 0; e < t.num_edges(); ++e)
    if (t.is_boundary(Edge{e})) {
      const Index a = index(t.tail(Edge{e})), b = index(t.head(Edge{e}));
      ends[a].push_back(b);
      ends[b].push_back(a);
    }
  return ends;
}

TEST(OpenMeshBorders, HaveNoCorners) {
  const Mesh mesh = jittered(triangle_grid(5, 4));
  const OurMesh ours = our_mesh("loop", mesh, 1, Boundary::edge_and_corner);
  const Matching m = match(ours, openmesh_refine(mesh, OpenMeshScheme::loop, 1));
  const Topology& control = ours.levels[0].topology();
  const auto ends = along_border(control);
  const Points& x = mesh.positions;
  int corners = 0;
  for (Index v = 0; v < ours.topology().num_vertices(); ++v) {
    if (v >= control.num_vertices() || control.num_faces(Vertex{v}) > 1) {
      EXPECT_LE(m.distance[v], reference);
      continue;
    }
    ++corners;
    const double moved = (x.row(ends[v][0]) + x.row(ends[v][1]) - 2 * x.row(v)).norm() / 8;
    EXPECT_NEAR(m.distance[v] * diagonal(ours.positions), moved, reference);
  }
  EXPECT_EQ(corners, 2);
}

TEST(OpenMeshBorders, OfCatmullClarkAreNoBSplines) {
  const Mesh mesh = jittered(grid(5, 4));
  const OurMesh ours = our_mesh("catmull-clark", mesh, 1);
  const PeerMesh theirs = openmesh_refine(mesh, OpenMeshScheme::catmull_clark, 1);
  const Matching m = match(ours, theirs);
  ASSERT_EQ(m.mismatch, "");
  const auto ends = along_border(ours.levels[0].topology());
  const Points& x = mesh.positions;
  for (Index v = 0; v < ours.topology().num_vertices(); ++v) {
    if (v >= mesh.num_vertices() || ends[v].empty()) {
      EXPECT_LE(m.distance[v], reference);
      continue;
    }
    const Eigen::RowVectorXd both = x.row(ends[v][0]) + x.row(ends[v][1]);
    EXPECT_LE((theirs.positions.row(m.vertex_map[v]) - (both + 4 * x.row(v)) / 6).norm(), reference * diagonal(x));
    EXPECT_LE((ours.positions.row(v) - (both + 6 * x.row(v)) / 8).norm(), reference * diagonal(x));
  }
}

// Level 0, regular interior vertices: a face with an edge on the border has the mask (apex 1/2, border edge 1/3 each,
// beyond the two other edges -1/12 each); a face that only touches the border takes the inner mask with vertices
// further along the border instead of those that are not there. We continue the mesh by virtual vertices instead. Where
// a corner is interior and extraordinary its ring alone decides, for both.
TEST(OpenMeshBorders, InterpolatorySqrt3NearBorders) {
  int inside = 0, touching = 0, at_border = 0, decided = 0;
  for (const Index n : {5, 6, 7}) {
    const Mesh mesh = jittered(fan(n, 3, 3));
    const Points& x = mesh.positions;
    const double tolerance = reference * diagonal(x);
    const OurMesh ours = our_mesh("interpolatory-sqrt3", mesh, 1);
    const PeerMesh theirs = openmesh_refine(mesh, OpenMeshScheme::interpolatory_sqrt3, 1);
    const Matching m = match(ours, theirs);
    ASSERT_EQ(m.mismatch, "");
    const Topology& control = ours.levels[0].topology();
    const Refinement& step = ours.levels[1].steps[0];
    for (Index f = 0; f < control.num_faces(); ++f) {
      const Index child = index(step.child(Face{f}));
      bool touches = false, extraordinary = false;
      HalfEdge border = no_half_edge;
      for (Index i = 0; i < 3; ++i) {
        const HalfEdge h = control.corner(Face{f}, i);
        const Vertex v = control.tail(h);
        touches |= control.is_boundary(v);
        extraordinary |= !control.is_boundary(v) && control.num_faces(v) != 6;
        if (!exists(control.twin(h))) border = h;
      }
      if (extraordinary || !touches) {
        EXPECT_LE(m.distance[child], reference);
        ++(extraordinary ? decided : inside);
      } else if (!exists(border)) {
        EXPECT_GT(m.distance[child], 1e-5);
        ++touching;
      } else {
        const auto point = [&](HalfEdge h) { return x.row(index(control.tail(h))); };
        const auto beyond = [&](HalfEdge h) { return point(control.prev(control.twin(h))); };
        const HalfEdge next = control.next(border), prev = control.prev(border);
        const Eigen::RowVectorXd expected =
            point(prev) / 2 + (point(border) + point(next)) / 3 - (beyond(next) + beyond(prev)) / 12;
        EXPECT_LE((theirs.positions.row(m.vertex_map[child]) - expected).norm(), tolerance);
        EXPECT_GT(m.distance[child], 1e-5);
        ++at_border;
      }
    }
    // The border curve, trisected in the second step, is the same.
    const OurMesh second = our_mesh("interpolatory-sqrt3", mesh, 2);
    const Matching m2 = match(second, openmesh_refine(mesh, OpenMeshScheme::interpolatory_sqrt3, 2));
    ASSERT_EQ(m2.mismatch, "");
    for (Index v = 0; v < second.topology().num_vertices(); ++v) {
      if (second.topology().is_boundary(Vertex{v})) {
        EXPECT_LE(m2.distance[v], reference);
      }
    }
  }
  for (const int count : {inside, touching, at_border, decided}) EXPECT_GT(count, 0);
}

TEST(OpenMeshBorders, OfMidpointsAreCutOff) {
  const Mesh mesh = jittered(grid(5, 4));
  const OurMesh ours = our_mesh("mid-edge", mesh, 1);
  const PeerMesh theirs = openmesh_refine(mesh, OpenMeshScheme::midpoint, 1);
  const Topology& control = ours.levels[0].topology();
  Index interior = 0;
  for (Index v = 0; v < control.num_vertices(); ++v) interior += !control.is_boundary(Vertex{v});
  EXPECT_EQ(theirs.positions.rows(), control.num_edges());
  EXPECT_EQ(Index(theirs.face_sizes.size()), control.num_faces() + interior);
  EXPECT_EQ(ours.topology().num_vertices(), control.num_edges() + control.num_vertices() - interior);
  std::set<Index> met;  // one of ours for each of theirs
  for (Index v = 0; v < theirs.positions.rows(); ++v) {
    Eigen::Index nearest;
    EXPECT_LE((ours.positions.rowwise() - theirs.positions.row(v)).rowwise().norm().minCoeff(&nearest), reference);
    met.insert(Index(nearest));
  }
  EXPECT_EQ(Index(met.size()), control.num_edges());
}

TEST(OpenMeshNumbers, AreRoundedToTheTypeOfNormals) {
  const Mesh mesh = jittered(icosahedron());
  const PeerMesh theirs = openmesh_refine(mesh, OpenMeshScheme::loop, 3, OpenMeshNormals::single);
  const Matching m = match(our_mesh("loop", mesh, 3), theirs);
  EXPECT_EQ(m.mismatch, "");
  EXPECT_GT(m.error, 1e-9);
  constexpr double in_float = 1e-6;  // normals in float round positions with them
  EXPECT_LT(m.error, in_float);
}

TEST(IrregularMeshes, HaveAllValencesAndFaceSizes) {
  std::set<Index> valences, sizes;
  const auto collect = [&](const std::vector<NamedMesh>& meshes) {
    valences.clear();
    sizes.clear();
    for (const NamedMesh& mesh : meshes) {
      const Topology t(view(mesh.mesh));
      EXPECT_TRUE(t.is_manifold()) << mesh.name;
      EXPECT_TRUE(t.faults().empty()) << mesh.name;
      for (Index v = 0; v < t.num_vertices(); ++v) valences.insert(t.num_faces(Vertex{v}));
      for (Index f = 0; f < t.num_faces(); ++f) sizes.insert(t.size(Face{f}));
    }
  };
  collect(closed_triangle_meshes());
  for (Index n = 3; n <= 10; ++n) EXPECT_TRUE(valences.contains(n)) << n;
  collect(closed_polygon_meshes());
  for (Index n = 3; n <= 10; ++n) EXPECT_TRUE(valences.contains(n) && sizes.contains(n)) << n;
}

}  // namespace
}  // namespace sublimit::testing

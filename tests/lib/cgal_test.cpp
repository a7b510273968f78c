// SPDX-License-Identifier: Apache-2.0
// Refined meshes against CGAL 5.5's Subdivision_method_3, live: positions after three levels to 1e-13 of the bounding
// box, connectivity as it is.
//
// Where its rules are ours, all of them found by running it:
//   PQQ with Linear_mask_3    inside: bilinear
//   CatmullClark, Loop        everywhere, borders too; Loop's weights, which are Warren's at valences 3 and 6 only
//   Sqrt3                     everywhere, borders too
//   DooSabin                  inside: the weights with cosines, not those of averaging
// Where they are not:
//   corners                   border vertices of a single face are smoothed as all others are: boundary edge_only here
//   PQQ with Linear_mask_3    border vertices get no position: whatever the memory held
//   DooSabin                  borders have no points and no faces: meshes shrink; all points that there are, are ours
#include <gtest/gtest.h>

#include <set>

#include "meshes/irregular_meshes.h"
#include "meshes/match_meshes.h"
#include "peers/cgal_reference.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Matching against_cgal(const std::string& scheme, CgalScheme peer, const Mesh& mesh, int levels,
                      Boundary boundary = Boundary::edge_only) {
  return match(our_mesh(scheme, mesh, levels, boundary), cgal_refine(mesh, peer, levels));
}

class Cgal : public ::testing::TestWithParam<SchemeOnMesh> {};

TEST_P(Cgal, RefinesAsWeDo) {
  const auto& [scheme, name, mesh] = GetParam();
  const Matching m = against_cgal(scheme, cgal_scheme(scheme).value(), mesh, 3);
  EXPECT_EQ(m.mismatch, "");
  EXPECT_LE(m.error, reference);
}

INSTANTIATE_TEST_SUITE_P(ClosedTriangles, Cgal,
                         ::testing::ValuesIn(schemes_on({"loop", "sqrt3"}, closed_triangle_meshes())), name_of_test);
INSTANTIATE_TEST_SUITE_P(ClosedPolygons, Cgal,
                         ::testing::ValuesIn(schemes_on({"bilinear", "catmull-clark", "doo-sabin"},
                                                        closed_polygon_meshes())),
                         name_of_test);
INSTANTIATE_TEST_SUITE_P(BordersOfTriangles, Cgal,
                         ::testing::ValuesIn(schemes_on({"loop", "sqrt3"}, open_triangle_meshes())), name_of_test);
INSTANTIATE_TEST_SUITE_P(BordersOfPolygons, Cgal,
                         ::testing::ValuesIn(schemes_on({"catmull-clark"}, open_polygon_meshes())), name_of_test);

// A variant with other weights meets its sister where the weights coincide, and only there: the comparison sees
// weights.
TEST(CgalVariants, CoincideOnRegularMeshesOnly) {
  struct Variant {
    std::string scheme;
    CgalScheme sister;
    Mesh same, different;
  };
  const Mesh quads = torus(5, 4);
  for (const Variant& v : {Variant{"loop-warren", CgalScheme::loop, triangle_torus(5, 4), octahedron()},
                           Variant{"loop-warren", CgalScheme::loop, tetrahedron(), icosahedron()},
                           Variant{"averaging", CgalScheme::catmull_clark, quads, prism(5)},
                           Variant{"doo-sabin-averaging", CgalScheme::doo_sabin, quads, prism(5)}}) {
    SCOPED_TRACE(v.scheme);
    EXPECT_LE(against_cgal(v.scheme, v.sister, jittered(v.same), 3).error, reference);
    const Matching m = against_cgal(v.scheme, v.sister, jittered(v.different), 3);
    EXPECT_EQ(m.mismatch, "");
    EXPECT_GT(m.error, 1e-3);
  }
}

TEST(CgalBorders, HaveNoCorners) {
  const Mesh mesh = jittered(grid(5, 4));
  const OurMesh ours = our_mesh("catmull-clark", mesh, 1, Boundary::edge_and_corner);
  const Matching m = match(ours, cgal_refine(mesh, CgalScheme::catmull_clark, 1));
  const Topology& control = ours.levels[0].topology();
  int corners = 0;
  for (Index v = 0; v < ours.topology().num_vertices(); ++v) {
    const bool corner = v < control.num_vertices() && control.num_faces(Vertex{v}) == 1;
    corners += corner;
    if (corner) {
      EXPECT_GT(m.distance[v], 1e-3);
    } else {
      EXPECT_LE(m.distance[v], reference);
    }
  }
  EXPECT_EQ(corners, 4);
}

TEST(CgalBorders, OfDooSabinAreCutOff) {
  const Mesh mesh = jittered(grid(5, 4));
  const OurMesh ours = our_mesh("doo-sabin", mesh, 1);
  const PeerMesh theirs = cgal_refine(mesh, CgalScheme::doo_sabin, 1);
  const Topology& control = ours.levels[0].topology();
  Index interior_vertices = 0, interior_edges = 0;
  for (Index v = 0; v < control.num_vertices(); ++v) interior_vertices += !control.is_boundary(Vertex{v});
  for (Index e = 0; e < control.num_edges(); ++e) interior_edges += !control.is_boundary(Edge{e});
  EXPECT_EQ(theirs.positions.rows(), control.num_half_edges());
  EXPECT_EQ(Index(theirs.face_sizes.size()), control.num_faces() + interior_edges + interior_vertices);
  std::set<Index> met;  // one of ours for each of theirs
  for (Index v = 0; v < theirs.positions.rows(); ++v) {
    Eigen::Index nearest;
    EXPECT_LE((ours.positions.rowwise() - theirs.positions.row(v)).rowwise().norm().minCoeff(&nearest), reference);
    met.insert(Index(nearest));
  }
  EXPECT_EQ(Index(met.size()), control.num_half_edges());
}

}  // namespace
}  // namespace sublimit::testing

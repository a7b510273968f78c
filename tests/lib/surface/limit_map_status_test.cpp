// SPDX-License-Identifier: Apache-2.0
// Statuses: what there is at a place, in one word, where it must be.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes/meshes.h"
#include "meshes/places.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Status = LimitStatus;

/// Radians between normals that are different ones: far more than rounding.
constexpr double clear_angle = 1e-3;

struct Answer {
  Status status;
  int order;
};

class Surface {
 public:
  Surface(const char* scheme, Mesh mesh, const SubdivisionOptions& options = {})
      : mesh_(std::move(mesh)), surface_(find_scheme(scheme).value(), mesh_, options) {}
  const LimitMap& operator*() const { return surface_; }
  const Topology& topology() const { return surface_.level().topology(); }

  /// Of a place and of evaluation, which must say the same by both ways that it has.
  Answer at(const Place& s, int order = 2) const {
    const LimitStencil stencil = surface_.stencil(s, order);
    const Index rows = Index(stencil.weights.rows());
    const std::vector<Place> one{s}, many(4 * size_t(topology().num_half_edges()) + 4, s);
    for (const std::vector<Place>& samples : {one, many}) {
      const LimitSamples found = surface_.evaluate(mesh_.positions, samples, order);
      EXPECT_EQ(found.status.back(), stencil.status) << name(found.status.back()) << ", " << name(stencil.status);
      EXPECT_EQ(int(found.order.back()), rows == 6 ? 2 : rows == 3 ? 1 : 0);
    }
    return {stencil.status, rows == 6 ? 2 : rows == 3 ? 1 : 0};
  }
  /// Near a vertex in a face that has it as corner: a along one edge, b along the other.
  Answer near(Index vertex, double a, double b, int order = 2) const {
    return at(from_corner(topology(), surface_.addresses(), topology().outgoing(Vertex{vertex}), a, b), order);
  }
  /// Place at s of the way from one vertex to another, in the face on the left.
  Place between(Index from, Index to, double s) const {
    for (Index i = 0; i < topology().num_half_edges(); ++i) {
      const HalfEdge h{i};
      if (index(topology().tail(h)) == from && index(topology().head(h)) == to)
        return on_edge(topology(), surface_.addresses(), h, s);
    }
    ADD_FAILURE() << "no half-edge from " << from << " to " << to;
    return {};
  }

 private:
  Mesh mesh_;
  LimitMap surface_;
};

void expect(const Answer& found, Status status, int order) {
  EXPECT_EQ(found.status, status) << name(found.status) << " instead of " << name(status);
  EXPECT_EQ(found.order, order);
}

// grid(4,4): vertex (i,j) has number 5 j + i.

TEST(LimitSurfaceStatus, RegularPlacesHaveAllDerivatives) {
  const Surface quads("catmull-clark", grid(4, 4)), triangles("loop", triangle_grid(4, 4));
  for (const Surface* surface : {&quads, &triangles}) {
    expect(surface->near(12, 0, 0), Status::regular, 2);  // a vertex
    expect(surface->near(12, 0.25, 0), Status::regular, 2);
    expect(surface->near(12, 0.3, 0.4), Status::regular, 2);
    expect(surface->near(12, 0.3, 0.4, 0), Status::regular, 0);
  }
}

TEST(LimitSurfaceStatus, BordersAreCreases) {
  for (const char* scheme : {"catmull-clark", "averaging", "kobbelt", "doo-sabin"}) {
    SCOPED_TRACE(scheme);
    const Surface surface(scheme, grid(4, 4));
    EXPECT_EQ(surface.at(surface.between(1, 2, 0.3)).status, Status::crease);
    EXPECT_EQ(surface.at(surface.between(1, 2, 0)).status, Status::crease);  // a vertex of the border
    EXPECT_EQ(surface.at(surface.between(0, 1, 0)).status, Status::crease);  // a corner
    EXPECT_NE(surface.at(surface.between(6, 7, 0.3)).status, Status::crease);
  }
  const Surface surface("catmull-clark", grid(4, 4));
  EXPECT_EQ(surface.at(surface.between(1, 2, 0.3)).order, 2);  // on the side of the face
}

TEST(LimitSurfaceStatus, CreasesBelongToBothSides) {
  Mesh mesh = grid(6, 6);  // vertex (i,j): 7 j + i
  add_crease(mesh, {21, 22, 23, 24, 25, 26, 27}, infinite_sharpness);
  const Surface surface("catmull-clark", mesh);
  expect(surface.at(surface.between(23, 24, 0.3)), Status::crease, 2);
  expect(surface.at(surface.between(24, 23, 0.3)), Status::crease, 2);
  expect(surface.at(surface.between(23, 24, 0)), Status::crease, 2);
  expect(surface.at(surface.between(23, 30, 0.3)), Status::regular, 2);
  // The normals of the two sides differ; derivatives along the crease do not.
  const Place left = surface.between(23, 24, 0.25), right = surface.between(24, 23, 0.75);
  const LimitSamples sides = (*surface).evaluate(mesh.positions, std::vector{left, right}, 1);
  EXPECT_GT((sides.normal.row(0) - sides.normal.row(1)).norm(), clear_angle);
  EXPECT_LE((sides.position.row(0) - sides.position.row(1)).norm(), rounding(64, 7));
  EXPECT_LE((sides.du.row(0) - sides.du.row(1)).norm(), rounding(256, 7));
}

TEST(LimitSurfaceStatus, SharpnessThatDecaysIsSmooth) {
  Mesh mesh = grid(6, 6);
  add_crease(mesh, {21, 22, 23, 24, 25, 26, 27}, 2.5f);
  const Surface surface("catmull-clark", mesh);
  expect(surface.at(surface.between(23, 24, 0.3)), Status::regular, 2);
  expect(surface.near(24, 0.1, 0.2), Status::regular, 2);
}

TEST(LimitSurfaceStatus, ExtraordinaryVerticesHaveTangentsOnly) {
  const Surface quads("catmull-clark", cube()), triangles("loop", octahedron()), sqrt3("sqrt3", octahedron());
  for (const Surface* surface : {&quads, &triangles, &sqrt3})
    for (int order = 0; order <= 2; ++order) expect(surface->near(3, 0, 0, order), Status::extraordinary, 0);
  EXPECT_GE((*quads).stencil({0, 0, 0}, 1).tangents.rows(), 2);
  expect(quads.near(3, std::ldexp(1.0, -40), 0), Status::regular, 2);
  // In the middle of an n-gon as well.
  const Surface pentagons("catmull-clark", prism(5));
  expect(pentagons.at({0, 1, 1}), Status::extraordinary, 0);
}

TEST(LimitSurfaceStatus, DartsAreExtraordinary) {
  Mesh mesh = grid(6, 6);
  add_crease(mesh, {21, 22, 23, 24}, infinite_sharpness);
  const Surface surface("catmull-clark", mesh);
  expect(surface.near(24, 0, 0), Status::extraordinary, 0);
  expect(surface.at(surface.between(23, 24, 0.99)), Status::crease, 2);
  expect(surface.at(surface.between(24, 25, 0.01)), Status::regular, 2);
}

TEST(LimitSurfaceStatus, SharpVerticesAreCorners) {
  Mesh mesh = grid(6, 6);
  mesh.corners = {{24, infinite_sharpness}};
  const Surface surface("catmull-clark", mesh);
  EXPECT_NE(surface.near(24, 0, 0).status, Status::regular);
  expect(surface.near(24, 0.25, 0.25), Status::regular, 2);
}

TEST(LimitSurfaceStatus, HolesAreHoles) {
  Mesh mesh = grid(4, 4);
  mesh.holes = {5};
  const Surface surface("catmull-clark", mesh);
  EXPECT_EQ(surface.at({5, 0.5, 0.25}).status, Status::hole);
  EXPECT_EQ(surface.at({6, 0.5, 0.25}).status, Status::regular);
  const Surface none("catmull-clark", grid(4, 4), {.boundary = Boundary::none, .creasing = {}});
  EXPECT_EQ(none.at({0, 0.5, 0.25}).status, Status::hole);
  EXPECT_EQ(none.at({5, 0.5, 0.25}).status, Status::regular);
}

TEST(LimitSurfaceStatus, SecondDerivativesThatJumpAreNamed) {
  const Surface quadratic("doo-sabin", grid(6, 6));
  expect(quadratic.at({14, 0.25, 0.25}), Status::regular, 2);
  expect(quadratic.at({14, 0.5, 0.25}), Status::unbounded_second, 1);  // where its pieces meet
  expect(quadratic.at({14, 0.5, 0.25}, 1), Status::regular, 1);
  const Surface zwart_powell("mid-edge", grid(6, 6));
  expect(zwart_powell.at({14, 0.125, 0.25}), Status::regular, 2);
  EXPECT_EQ(zwart_powell.at({14, 0.5, 0.25}).status, Status::unbounded_second);
  const Surface interpolating("butterfly", triangle_grid(6, 6));
  expect(interpolating.at({30, 0.3, 0.2}), Status::unbounded_second, 1);
  expect(interpolating.at({30, 0.3, 0.2}, 1), Status::regular, 1);
}

TEST(LimitSurfaceStatus, PointsThatCoincideHaveNoNormal) {
  Mesh mesh = grid(4, 4);
  mesh.positions.rowwise() = Eigen::RowVector3d(1, 2, 3);
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  for (const size_t count : {size_t(1), size_t(200)}) {
    const LimitSamples samples = surface.evaluate(mesh.positions, std::vector<Place>(count, Place{5, 0.25, 0.25}), 1);
    EXPECT_EQ(samples.status.back(), Status::undefined_normal);
    EXPECT_TRUE(samples.normal.bottomRows(1).isZero(0));
    EXPECT_LE((samples.position.bottomRows(1) - Eigen::RowVector3d(1, 2, 3)).norm(), rounding(16, 4));
  }
}

TEST(LimitSurfaceStatus, PointsOnALineHaveNoNormal) {
  Mesh mesh = grid(4, 4);
  mesh.positions.rightCols(2).setZero();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  for (const size_t count : {size_t(1), size_t(200)})
    EXPECT_EQ(surface.evaluate(mesh.positions, std::vector<Place>(count, Place{5, 0.25, 0.25}), 1).status.back(),
              Status::undefined_normal);
}

/// A grid folded to a wedge: du vanishes in the fold, second derivatives tell the normal of neither side.
TEST(LimitSurfaceStatus, NormalsSurviveAVanishingDerivative) {
  // x = u^3 has du = 0 at u = 0, the surface is a plane all the same.
  Mesh mesh = grid(8, 8);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const double i = v % 9 - 4, j = v / 9 - 4;
    mesh.positions.row(v) << i * i * i - i, j, 0;  // the cubic B-spline with these is u^3
  }
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  // Face (4,4) begins at vertex (4,4), which is u = 0.
  const LimitSamples samples = surface.evaluate(mesh.positions, std::vector<Place>{{36, 0, 0.25}, {36, 0.5, 0.25}}, 2);
  EXPECT_LE(samples.du.row(0).norm(), rounding(64, 60));
  EXPECT_LE((samples.normal.row(1) - Eigen::RowVector3d(0, 0, 1)).norm(), reference_angle);
  EXPECT_NEAR(samples.position(1, 0), 0.125, rounding(64, 60));
}

}  // namespace
}  // namespace sublimit::testing

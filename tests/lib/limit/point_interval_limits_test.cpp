// SPDX-License-Identifier: Apache-2.0
// Limits of Doo-Sabin with knot intervals: non-uniform biquadratic B-splines where the mesh is regular, the same
// surface from every level around extraordinary faces.
#include <gtest/gtest.h>

#include <random>

#include "meshes/knot_breaks.h"
#include "meshes/meshes.h"
#include "meshes/point_intervals.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Scheme<double> of_points = *find_scheme("doo-sabin-intervals");

/// A place in the quarter at a corner of a quadrilateral, u along the edge to the next corner, both from the new knot
/// to the face's, as a place in the face; and what its derivatives are by those of the face.
struct QuarterPlace {
  double u, v;
  double turn[2][2];
};
QuarterPlace in_face(Index corner, double x, double y) {
  switch (corner) {
    case 0:
      return {x / 2, y / 2, {{1, 0}, {0, 1}}};
    case 1:
      return {1 - y / 2, x / 2, {{0, 1}, {-1, 0}}};
    case 2:
      return {1 - x / 2, 1 - y / 2, {{-1, 0}, {0, -1}}};
    default:
      return {y / 2, 1 - x / 2, {{0, -1}, {1, 0}}};
  }
}

Eigen::RowVector3d weighted(const LimitStencil& stencil, const Points& points, Index row) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (size_t i = 0; i < stencil.vertices.size(); ++i)
    sum += stencil.weights(row, Index(i)) * points.row(stencil.vertices[i]);
  return sum;
}

TEST(PointIntervalLimits, OfATorusAreTheBSplineOfItsKnots) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> positive(0.2, 3), inside(0, 1);
  for (int run = 0; run < 2; ++run) {
    const Index m = 4 + run, n = 6 - run;
    Mesh mesh = jittered(torus(m, n), 0.2, unsigned(run) + 1);
    const Topology t(view(mesh));
    std::vector<double> a(m), b(n);  // of rows and columns of points
    for (double& d : a) d = positive(random);
    for (double& d : b) d = positive(random);
    for (Index i = 0; i < m; ++i)
      for (Index j = 0; j < n; ++j) {
        mesh.knot_intervals.push_back({i * n + j, (i + 1) % m * n + j, a[i]});
        mesh.knot_intervals.push_back({i * n + j, i * n + (j + 1) % n, b[j]});
      }
    using K = Knots<double>;
    const PatchSet patches(
        {std::make_shared<SplineSurface>(SplineSurface(K::closed(2, breaks_of(b)), K::closed(2, breaks_of(a))))});
    Points points(m * n, 3);
    for (Index i = 0; i < m; ++i)
      for (Index j = 0; j < n; ++j) points.row((i + 1) % m * n + (j + 1) % n) = mesh.positions.row(i * n + j);
    const LimitMap surface(of_points, mesh);
    for (int k = 0; k < 300; ++k) {
      const Index f = static_cast<Index>(random() % t.num_faces()), corner = static_cast<Index>(random() % 4);
      const auto parameter = [&] { return random() % 5 == 0 ? double(random() % 2) : inside(random); };
      const double x = parameter(), y = parameter();
      const QuarterPlace place = in_face(corner, x, y);
      const HalfEdge h = t.corner(Face{f}, corner);
      const Index v = index(t.tail(h)), next = index(t.head(h));
      // Nothing is levelled: new knots are in the middle of the point's patch, and its sides are the faces' knots.
      const bool u_is_row = v % n == next % n;
      const Index other = index(t.tail(t.prev(h)));
      const auto toward = [](Index i, Index j, Index count, double z) {
        return (i + 1) % count == j ? 0.5 + z / 2 : 0.5 - z / 2;
      };
      const double row = u_is_row ? toward(v / n, next / n, m, x) : toward(v / n, other / n, m, y),
                   column = u_is_row ? toward(v % n, other % n, n, y) : toward(v % n, next % n, n, x);
      // Its quarter alone has these derivatives: the other side of a knot has another interval.
      const double sr = u_is_row ? (row >= 0.5 && toward(v / n, next / n, m, 1) > 0.5 ? 1 : -1)
                                 : (toward(v / n, other / n, m, 1) > 0.5 ? 1 : -1),
                   sc = u_is_row ? (toward(v % n, other % n, n, 1) > 0.5 ? 1 : -1)
                                 : (toward(v % n, next % n, n, 1) > 0.5 ? 1 : -1);
      const Place at{v, column, row};
      const LimitSamples truth = patches.evaluate(points, std::span(&at, 1), 1);
      const LimitStencil own = surface.stencil({f, place.u, place.v}, 1);
      ASSERT_EQ(own.weights.rows() >= 3, true);
      EXPECT_LE((weighted(own, mesh.positions, 0) - truth.position.row(0)).norm(), reference) << f << ' ' << corner;
      if (x == 1 || y == 1) continue;
      const Eigen::RowVector3d du = weighted(own, mesh.positions, 1), dv = weighted(own, mesh.positions, 2);
      const Eigen::RowVector3d along_x = place.turn[0][0] * du + place.turn[0][1] * dv,
                               along_y = place.turn[1][0] * du + place.turn[1][1] * dv;
      const Eigen::RowVector3d by_row = sr * truth.dv.row(0), by_column = sc * truth.du.row(0);
      EXPECT_LE((along_x - (u_is_row ? by_row : by_column)).norm(), other_route) << f << ' ' << corner;
      EXPECT_LE((along_y - (u_is_row ? by_column : by_row)).norm(), other_route) << f << ' ' << corner;
    }
  }
}

/// The middle part of a face's quarter is the next level's: the same points, and derivatives as much shorter.
TEST(PointIntervalLimits, AreTheSameFromTheNextLevel) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> inside(0, 1);
  unsigned seed = 2;
  for (const Mesh& plain : {jittered(octahedron(), 0.1), jittered(quads_from_triangles(octahedron()), 0.1),
                            jittered(quads_from_triangles(icosahedron()), 0.05)}) {
    const Mesh mesh = with_point_intervals(plain, ++seed, 4);
    const Level control = control_level(of_points, mesh), next = next_level(of_points, control);
    ASSERT_FALSE(next.intervals.empty());
    const Topology &t = control.topology(), &fine = next.topology();
    const LimitMap coarse_surface(of_points, control), fine_surface(of_points, next);
    const Points points = mesh.positions, fine_points = next.S * mesh.positions;
    const KnotSplit split = *next.knots();
    for (int k = 0; k < 120; ++k) {
      const Face f{static_cast<Index>(random() % t.num_faces())};
      const Index corner = static_cast<Index>(random() % t.size(f));
      const HalfEdge h = fine.corner(f, corner);
      const auto cut = [&](size_t entry) { return 1 - split.distance[entry] / split.length[entry]; };
      const double cu = cut(knot_entry(KnotOwner::point, fine, h)),
                   cv = cut(other_end(knot_entry(KnotOwner::point, fine, fine.prev(h))));
      const double x = k % 6 == 0 ? 1 : inside(random), y = k % 6 == 0 ? 1 : inside(random);
      const auto stencil = [&](const LimitMap& surface, double u, double v) {
        if (t.size(f) != 4) return surface.stencil({surface.addresses().first(f) + corner, u, v}, 1);
        const QuarterPlace place = in_face(corner, u, v);
        LimitStencil result = surface.stencil({surface.addresses().first(f), place.u, place.v}, 1);
        if (result.weights.rows() < 3) return result;
        const RowMatrix du = result.weights.row(1) / 2, dv = result.weights.row(2) / 2;
        for (int i = 0; i < 2; ++i) result.weights.row(1 + i) = place.turn[i][0] * du + place.turn[i][1] * dv;
        return result;
      };
      const LimitStencil a = stencil(coarse_surface, cu + (1 - cu) * x, cv + (1 - cv) * y),
                         b = stencil(fine_surface, x, y);
      EXPECT_LE((weighted(a, points, 0) - weighted(b, fine_points, 0)).norm(), reference);
      if (x == 1 || y == 1 || a.weights.rows() < 3 || b.weights.rows() < 3) continue;
      EXPECT_LE((weighted(a, points, 1) * (1 - cu) - weighted(b, fine_points, 1)).norm(), other_route);
      EXPECT_LE((weighted(a, points, 2) * (1 - cv) - weighted(b, fine_points, 2)).norm(), other_route);
    }
  }
}

/// Refined far, a point comes as near to its limit as its level's own points come together.
TEST(PointIntervalLimits, AreWhatRefinementTendsTo) {
  const Mesh mesh = with_point_intervals(jittered(quads_from_triangles(tetrahedron()), 0.1), 4, 4);
  const std::vector<Level> levels = refine(of_points, mesh, 6);
  Points points = mesh.positions;
  for (size_t k = 1; k < levels.size(); ++k) points = levels[k].S * points;
  const LimitMap surface(of_points, mesh);
  const Topology &t = levels[0].topology(), &fine = levels.back().topology();
  for (Index f = 0; f < t.num_faces(); ++f) {
    // Faces from faces keep their numbers: the middle of a face stays the middle.
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    double size = 0;
    for (Index k = 0; k < fine.size(Face{f}); ++k) mean += points.row(index(fine.tail(fine.corner(Face{f}, k))));
    mean /= double(fine.size(Face{f}));
    for (Index k = 0; k < fine.size(Face{f}); ++k)
      size = std::max(size, (points.row(index(fine.tail(fine.corner(Face{f}, k)))) - mean).norm());
    const LimitStencil own = surface.stencil({f, 0.5, 0.5}, 0);
    EXPECT_LE((weighted(own, mesh.positions, 0) - mean).norm(), size) << f;
    EXPECT_LE(size, 0.05);
  }
}

TEST(PointIntervalLimits, NextToBordersIntervalsAreEqual) {
  Mesh mesh = jittered(grid(5, 5), 0.1);
  for (Index i = 0; i < 36; ++i)
    if (i % 6 < 5)
      mesh.knot_intervals.insert(mesh.knot_intervals.end(), {{i, i + 1, 1.0 + i % 6}, {i + 1, i, 2.0 + i % 6}});
  expect_error<NoLimit>(
      [&] {
        LimitMap(of_points, mesh).stencil({2, 0.2, 0.2}, 0);
      },
      {"borders", "intervals are equal", "boundary none"});
  // Without borders there are the faces inside.
  const LimitMap surface(of_points, mesh, {.boundary = Boundary::none, .creasing = {}});
  EXPECT_EQ(surface.stencil({12, 0.3, 0.4}, 1).status, LimitStatus::regular);
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Nearest points and rays of patches: against spheres, tori and cylinders as equations, and against limit surfaces that
// are the same B-splines.
#include "sublimit/parts/parted_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "meshes/construction_data.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/patches/constructions/revolution.h"
#include "sublimit/patches/constructions/ruled.h"
#include "sublimit/patches/constructions/screw_surface.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/detail/basis_surface.h"
#include "sublimit/patches/detail/cut_patch.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/detail/winding.h"
#include "sublimit/search/intersect.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Searched {
  PatchSet set;
  Points columns;
  PartedPatches surface() const { return {set, columns}; }
};
Searched searched(std::shared_ptr<const Patch> patch, Points columns, Coordinates coordinates = Coordinates::plain) {
  return {PatchSet({std::move(patch)}, coordinates), std::move(columns)};
}
Searched searched(const SplineNet& net) { return searched(net.surface, net.columns, net.coordinates); }

Searched sphere(double radius) { return searched(revolution(circle_arcs(0, radius, 2))); }
Searched ring() { return searched(revolution(circle_arcs(2, 0.75, 4))); }

Points random_queries(int count, double spread, unsigned seed) {
  std::mt19937 random(seed);
  return spread * random_points(random, count, 3);
}
std::vector<Ray> random_rays(int count, double spread, unsigned seed) {
  const Points from = random_queries(count, spread, seed), to = random_queries(count, 1, seed + 1);
  std::vector<Ray> rays;
  for (Eigen::Index i = 0; i < count; ++i)
    rays.push_back({from.row(i).transpose(), (to.row(i) - from.row(i)).transpose()});
  return rays;
}

TEST(PartedPatches, DistancesFromASphereAreThoseOfItsEquation) {
  const Searched s = sphere(1.5);
  const PartedPatches surface = s.surface();
  const Points queries = random_queries(200, 3, 1);
  const ClosestPoints found = closest(surface, queries, {.is_signed = true});
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    const double expected = queries.row(i).norm() - 1.5;
    EXPECT_NEAR(found.distances[i], expected, found_distance * 3) << queries.row(i);
    EXPECT_NEAR(found.lower[i], std::abs(expected), 3 * found_distance) << queries.row(i);
    EXPECT_LE((found.points.row(i) - 1.5 * queries.row(i).normalized()).norm(), found_hit);
  }
}

TEST(PartedPatches, DistancesFromATorusAreThoseOfItsEquation) {
  const Searched s = ring();
  const Points queries = random_queries(200, 4, 3);
  const ClosestPoints found = closest(s.surface(), queries, {.is_signed = true});
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    const double expected = std::hypot(queries.row(i).head<2>().norm() - 2, queries(i, 2)) - 0.75;
    EXPECT_NEAR(found.distances[i], expected, 5 * found_distance);
    EXPECT_NEAR(found.lower[i], std::abs(expected), 5 * found_distance);
  }
}

TEST(PartedPatches, RaysHitATorusAsOftenAsItsEquationChangesSign) {
  const Searched s = ring();
  const auto inside = [](const Eigen::Vector3d& x) { return 0.75 - std::hypot(x.head<2>().norm() - 2, x[2]); };
  const std::vector<Ray> rays = random_rays(300, 6, 5);
  const RayHits hits = intersect(s.surface(), rays, {.all = true});
  int several = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    // Steps of 1/4000 tell changes apart unless the ray all but touches, which is left out.
    int changes = 0;
    double least = 1;
    constexpr int steps = 12000;
    for (int k = 0; k < steps; ++k) {
      const double a = inside(rays[i].origin + rays[i].direction * (3.0 * k / steps)),
                   b = inside(rays[i].origin + rays[i].direction * (3.0 * (k + 1) / steps));
      changes += (a > 0) != (b > 0);
      least = std::min(least, std::max(std::abs(a), std::abs(b)));
    }
    std::int64_t below = 0;
    for (auto k = size_t(hits.first[i]); k < size_t(hits.first[i + 1]); ++k) {
      const Eigen::Vector3d x = rays[i].origin + hits.t[k] * rays[i].direction;
      EXPECT_NEAR(inside(x), 0, found_hit);
      EXPECT_LE((hits.points.row(Eigen::Index(k)).transpose() - x).norm(), found_hit);
      below += hits.t[k] < 3;
    }
    EXPECT_EQ(below, changes) << "ray " << i;
    several += changes > 2;
  }
  EXPECT_GT(several, 5);
}

/// How far rays pass beside a pole.
constexpr double beside_poles[]{0, 1e-16, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3};

/// Rays from outside by a point, along random directions.
std::vector<Ray> rays_beside(const Eigen::Vector3d& point, int directions, unsigned seed) {
  const Points random = random_queries(2 * directions, 1, seed);
  std::vector<Ray> rays;
  for (int i = 0; i < directions; ++i) {
    // Along the axis first, which looks at the pole from above.
    const Eigen::Vector3d along = i == 0 ? Eigen::Vector3d(0, 0, -1) : Eigen::Vector3d(random.row(2 * i)).normalized();
    const Eigen::Vector3d aside = along.cross(Eigen::Vector3d(random.row(2 * i + 1))).normalized();
    for (const double beside : beside_poles) rays.push_back({point + beside * aside - 5 * along, along});
  }
  return rays;
}

// |x|^2 = r^2 along the ray, as roots of a quadratic equation.
TEST(PartedPatches, RaysThroughPolesHitASphereWhereItsEquationSays) {
  constexpr double radius = 1.5;
  const Searched s = sphere(radius);
  for (const double pole : {radius, -radius}) {
    const std::vector<Ray> rays = rays_beside({0, 0, pole}, 25, 11);
    const RayHits hits = intersect(s.surface(), rays, {.all = true, .most_parts = 2000});
    for (size_t i = 0; i < rays.size(); ++i) {
      const double b = rays[i].origin.dot(rays[i].direction),
                   discriminant = b * b - rays[i].origin.squaredNorm() + radius * radius;
      if (std::abs(discriminant) < 1e-4) continue;  // it all but touches
      ASSERT_EQ(hits.first[i + 1] - hits.first[i], discriminant > 0 ? 2 : 0) << i;
      for (int k = 0; discriminant > 0 && k < 2; ++k) {
        const auto hit = size_t(hits.first[i] + k);
        EXPECT_EQ(hits.kinds[hit], HitKind::crossing) << i;
        EXPECT_NEAR(hits.t[hit], -b + (k == 0 ? -1 : 1) * std::sqrt(discriminant), 100 * found_hit) << i;
      }
    }
  }
}

// A cone about the z axis, x^2 + y^2 = (2 - z)^2 / 4 from z = 0 to its apex at z = 2, of a line turned.
TEST(PartedPatches, RaysThroughTheApexOfAConeHitIt) {
  Points line(2, 2);
  line << 1, 0, 0, 2;
  const Searched s = searched(revolution({bezier_knots<double>(1), line}));
  const std::vector<Ray> down = rays_beside({0, 0, 2}, 1, 13);
  const RayHits hits = intersect(s.surface(), down, {.all = true, .most_parts = 2000});
  for (size_t i = 0; i < down.size(); ++i) {
    ASSERT_EQ(hits.first[i + 1] - hits.first[i], 1) << i;
    const auto hit = size_t(hits.first[i]);
    EXPECT_EQ(hits.kinds[hit], HitKind::crossing) << i;
    EXPECT_NEAR(hits.t[hit], 5 + 2 * beside_poles[i], found_hit) << i;
  }
  // From the side the apex is touched, or passed.
  const RayHits aside = intersect(s.surface(), {{{-5, 0, 2}, {1, 0, 0}}, {{-5, 0, 2.001}, {1, 0, 0}}}, {.all = true});
  ASSERT_EQ(aside.first, (std::vector<std::int64_t>{0, 1, 1}));
  EXPECT_EQ(aside.kinds[0], HitKind::touching);
}

/// A closed uniform bicubic B-spline, and the limit of catmull-clark over its net.
struct SameSurface {
  Searched patches;
  Mesh mesh;
};
SameSurface bicubic_torus() {
  const Knots<double> u = Knots<double>::closed(3, {0, 1, 2, 3, 4, 5}), v = Knots<double>::closed(3, {0, 1, 2, 3, 4});
  const auto spline = std::make_shared<const SplineSurface>(u, v);
  Points columns(20, 3);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i)
      columns.row(i + 5 * j) << cos_degrees(72 * i) * (2 + cos_degrees(90 * j)),
          sin_degrees(72 * i) * (2 + cos_degrees(90 * j)), sin_degrees(90 * j) + 0.1 * i;
  SameSurface same{searched(spline, columns), {}};
  const PatchSet::Net net = same.patches.set.net();
  same.mesh.positions = columns;
  same.mesh.face_sizes = net.sizes;
  same.mesh.face_vertices = net.vertices;
  return same;
}

TEST(PartedPatches, AreTheLimitsOfTheSameBsplines) {
  const SameSurface same = bicubic_torus();
  const LimitMap limit(find_scheme("catmull-clark").value(), same.mesh);
  const PartedPatches surface = same.patches.surface();
  const Points queries = random_queries(200, 3, 7);
  const ClosestPoints a = closest(surface, queries, {.is_signed = true}),
                      b = closest(limit, same.mesh.positions, queries, {.is_signed = true});
  EXPECT_LE((a.distances - b.distances).cwiseAbs().maxCoeff(), 5 * found_distance);
  EXPECT_LE((a.lower - b.lower).cwiseAbs().maxCoeff(), 5 * found_distance);
  const std::vector<Ray> rays = random_rays(200, 6, 9);
  const RayHits hit = intersect(surface, rays, {.all = true}),
                same_hits = intersect(limit, same.mesh.positions, rays, {.all = true});
  ASSERT_EQ(hit.first, same_hits.first);
  ASSERT_GT(hit.t.size(), 100u);
  for (size_t k = 0; k < hit.t.size(); ++k) EXPECT_NEAR(hit.t[k], same_hits.t[k], found_hit);
  EXPECT_LE((hit.normals - same_hits.normals).rowwise().norm().maxCoeff(), reference_angle);
}

TEST(PartedPatches, SingleRaysHitWhatManyDo) {
  const Searched s = ring();
  const PartedPatches surface = s.surface();
  const RayTracer tracer(surface);
  const std::vector<Ray> rays = random_rays(50, 5, 11);
  const RayHits hits = intersect(surface, rays);
  for (size_t i = 0; i < rays.size(); ++i) {
    const std::vector<RayHit> found = tracer.trace(rays[i]);
    ASSERT_EQ(std::ssize(found), hits.first[i + 1] - hits.first[i]);
    for (const RayHit& hit : found) EXPECT_EQ(hit.t, hits.t[size_t(hits.first[i])]);
  }
}

TEST(PartedPatches, NoPointOfAnyKindIsNearer) {
  std::mt19937 random(13);
  const auto triangle = std::make_shared<const TrianglePatch>(3, 1);
  const auto cardinal =
      std::make_shared<const BasisSurface>(SegmentBasis::cardinal({0, 1, 2}), SegmentBasis::cardinal({0, 1, 2.5}));
  const auto spline = std::make_shared<const SplineSurface>(unit_knots(random, 4), unit_knots(random, 2));
  const std::vector<std::shared_ptr<const Patch>> patches{
      triangle, cardinal, spline,
      std::make_shared<const CutPatch>(cardinal, Eigen::Array2d(0.5, 0.25), Eigen::Array2d(1.75, 2))};
  for (const auto& patch : patches) {
    const Searched s = searched(patch, random_points(random, patch->num_points(), 3));
    const Points queries = random_queries(40, 1.5, 17);
    const ClosestPoints found = closest(s.surface(), queries);
    const LimitSamples grid = s.set.evaluate(s.columns, s.set.grid(40));
    for (Eigen::Index i = 0; i < queries.rows(); ++i) {
      const double near = (grid.position.rowwise() - queries.row(i)).rowwise().norm().minCoeff();
      EXPECT_LE(found.distances[i], near + found_distance);
      EXPECT_GE(found.distances[i], near - 0.25);  // the grid is coarse, but no more than that
      EXPECT_NEAR(found.lower[i], found.distances[i], 5 * found_distance);
    }
  }
}

/// A cylinder about the z axis over an arc of 240 degrees: the weight in its middle is -1/2, the denominator 1/4 at
/// least.
Searched wide_cylinder() {
  Points arc(3, 4);
  arc << cos_degrees(120), -sin_degrees(120), 0, 1, 1, 0, 0, cos_degrees(120), cos_degrees(120), sin_degrees(120), 0, 1;
  Points columns(6, 4);
  columns << arc, arc;
  columns.bottomRows(3).col(2) = 2 * arc.col(3);
  return searched(std::make_shared<const SplineSurface>(bezier_knots<double>(2), bezier_knots<double>(1)), columns,
                  Coordinates::homogeneous);
}

TEST(PartedPatches, WeightsBelowZeroAreNoMatterWhereTheDenominatorIsAbove) {
  const Searched s = wide_cylinder();
  const PartedPatches surface = s.surface();
  EXPECT_EQ(surface.without_parts(), "");
  Points queries(3, 3);
  queries << 2, 0.5, 1, 0.25, -0.125, 0.5, 0.5, 1, 3;
  const ClosestPoints found = closest(surface, queries);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double expected = std::hypot(queries.row(i).head<2>().norm() - 1, std::max(queries(i, 2) - 2, 0.0));
    EXPECT_NEAR(found.distances[i], expected, found_distance);
    EXPECT_NEAR(found.lower[i], expected, 3 * found_distance);
  }
  const RayHits hits = intersect(surface, {{.origin = {5, 0, 1}, .direction = {-1, 0, 0}}}, {.all = true});
  ASSERT_EQ(hits.t.size(), 1u);  // behind, the arc has its gap
  EXPECT_NEAR(hits.t[0], 4, found_hit);
}

TEST(PartedPatches, PolesAndScrewsAreSearchedWithoutProofAndNotTraced) {
  Searched poles = wide_cylinder();
  poles.columns(1, 3) = poles.columns(4, 3) = -1.5;
  const Knots<double> line = bezier_knots<double>(1);
  const auto screw = std::make_shared<const ScrewSurface>(line, 0, 6);
  Points profile(2, 3);
  profile << 1, 0, 0, 2, 0, 0;
  const Searched screws = searched(screw, screw->columns({line, profile}, 1));
  for (const Searched* s : std::initializer_list<const Searched*>{&poles, &screws}) {
    const PartedPatches surface = s->surface();
    Points query(1, 3);
    query << 1.5, 0, 0.25;
    const ClosestPoints found = closest(surface, query);
    EXPECT_EQ(found.lower[0], 0);
    const LimitSamples grid = s->set.evaluate(s->columns, s->set.grid(100));
    double near = INFINITY;
    for (Eigen::Index i = 0; i < grid.position.rows(); ++i)
      if (grid.status[size_t(i)] == LimitStatus::regular)
        near = std::min(near, (grid.position.row(i) - query.row(0)).norm());
    EXPECT_LE(found.distances[0], near + found_distance);
    expect_error<UnsupportedTopology>([&] { intersect(surface, {{.direction = {1, 0, 0}}}); }, {"face 0, of patch 0"});
    expect_error<UnsupportedTopology>([&] { RayTracer{surface}; }, {"face 0, of patch 0"});
  }
}

TEST(PartedPatches, OpenOnesHaveNoInside) {
  const Points query = Points::Zero(1, 3);
  const Searched half = searched(revolution(circle_arcs(0, 1, 2), {.sweep_degrees = 180}));
  expect_error<UnsupportedTopology>([&] { winding_numbers(half.surface(), query); },
                                    {"closed", "patch 0 has a side that is no other one's"});
  // Two halves of a sphere whose normals look to different sides.
  const SplineNet back = revolution(circle_arcs(0, 1, 2), {.sweep_degrees = -180}),
                  front = revolution(circle_arcs(0, 1, 2), {.sweep_degrees = 180});
  Points columns(back.columns.rows() + front.columns.rows(), 4);
  columns << front.columns, back.columns;
  const Searched turned{PatchSet({front.surface, back.surface}, Coordinates::homogeneous), columns};
  expect_error<UnsupportedTopology>([&] { winding_numbers(turned.surface(), query); },
                                    {"normals of patches 0 and 1 look to different sides"});
  const Searched triangle = searched(std::make_shared<const TrianglePatch>(1), Points::Identity(3, 3));
  expect_error<UnsupportedTopology>([&] { winding_numbers(triangle.surface(), query); },
                                    {"face 0 has a side that is no other one's"});
}

// Patches that are no B-splines are closed as their sides say: a tetrahedron of four triangles, and one of them turned
// over.
TEST(PartedPatches, TrianglesCloseATetrahedron) {
  const auto patch = std::make_shared<const TrianglePatch>(1);
  const Points corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto made_of = [&](const std::vector<std::array<int, 3>>& faces) {
    std::vector<std::shared_ptr<const Patch>> patches(faces.size(), patch);
    Points columns(3 * Index(faces.size()), 3);
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) columns.row(Index(3 * f + k)) = corners.row(faces[f][k]);
    return Searched{PatchSet(patches), columns};
  };
  const Searched closed = made_of({{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const ClosestPoints found = closest(closed.surface(), Points{{0.1, 0.2, 0.3}, {-0.5, 0.2, 0.2}}, {.is_signed = true});
  EXPECT_NEAR(found.distances[0], -0.1, found_distance);
  EXPECT_NEAR(found.distances[1], 0.5, found_distance);
  const LimitIntegrals integrals = limit_integrals(Patches(closed.set, closed.columns));
  ASSERT_TRUE(integrals.solid) << integrals.why_no_solid;
  EXPECT_NEAR(integrals.solid->volume, 1. / 6, other_route);
  EXPECT_NEAR(integrals.area, 1.5 + std::sqrt(3) / 2, other_route);
  EXPECT_NE(
      made_of({{0, 1, 2}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}).surface().why_not_closed().find("turn one of them over"),
      std::string::npos);
  EXPECT_NE(
      made_of({{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 2, 1}}).surface().why_not_closed().find("two others"),
      std::string::npos);
}

TEST(PartedPatches, ControlPointsAreFiniteAndAsMany) {
  const Searched s = ring();
  Points columns = s.columns;
  columns(3, 1) = NAN;
  expect_error<InvalidMesh>([&] { PartedPatches(s.set, columns); }, {"not finite"});
  expect_error<InvalidParameter>([&] { PartedPatches(s.set, Points(s.columns.topRows(3))); }, {});
}

}  // namespace
}  // namespace sublimit::testing

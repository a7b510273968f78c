// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/intersect.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "meshes/meshes.h"
#include "meshes/places.h"
#include "sublimit/base/error.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/detail/tracer.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using namespace testing;

double diagonal(const Mesh& mesh) { return testing::diagonal(mesh.positions); }

/// Through the box, from outside.
std::vector<Ray> random_rays(const Mesh& mesh, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d middle = mesh.positions.colwise().mean();
  std::vector<Ray> rays(static_cast<size_t>(count));
  for (Ray& ray : rays) {
    Eigen::Vector3d d(normal(random), normal(random), normal(random)),
        off(normal(random), normal(random), normal(random));
    ray.direction = 2 * d.normalized();
    ray.origin = middle + 0.2 * diagonal(mesh) * off - 3 * diagonal(mesh) * d.normalized();
  }
  return rays;
}

struct Case {
  const char* scheme;
  Mesh mesh;
};
std::vector<Case> closed_cases() {
  Mesh creased = cube();
  add_crease(creased, {0, 1, 3}, {10, 1.5f});
  return {{"bilinear", jittered(cube())},
          {"catmull-clark", jittered(creased)},
          {"catmull-clark", jittered(prism(5))},
          {"catmull-clark", torus(7, 5)},
          {"loop", jittered(icosahedron())},
          {"loop", triangle_torus(6, 5)},
          {"doo-sabin", jittered(prism(5))},
          {"averaging", torus(6, 4)},
          {"kobbelt", jittered(cube())},
          {"butterfly", jittered(icosahedron())},
          {"sqrt3", jittered(icosahedron())},
          {"interpolatory-sqrt3", jittered(icosahedron())},
          {"modified-butterfly", jittered(octahedron())}};
}

TEST(Intersect, HitsAreOnRayAndSurface) {
  for (const Case& c : closed_cases()) {
    const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
    const std::vector<Ray> rays = random_rays(c.mesh, 200, 1);
    const RayHits hits = intersect(surface, c.mesh.positions, rays, {.all = true});
    const double size = diagonal(c.mesh);
    int met = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(hits.undecided[i], 0) << c.scheme;
      double before = -1;
      for (auto k = size_t(hits.first[i]); k < size_t(hits.first[i + 1]); ++k, ++met) {
        const Eigen::Vector3d on_ray = rays[i].origin + hits.t[k] * rays[i].direction;
        EXPECT_LE((on_ray - hits.points.row(Eigen::Index(k)).transpose()).norm(), found_hit * size) << c.scheme;
        EXPECT_GT(hits.t[k], before);
        before = hits.t[k];
      }
    }
    EXPECT_GT(met, 100) << c.scheme;
  }
}

// A ray goes in as often as it comes out, and turns sign by sign: none is missed, and none counts twice.
TEST(Intersect, RaysEnterAndLeaveClosedSurfaces) {
  for (const Case& c : closed_cases()) {
    const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
    const std::vector<Ray> rays = random_rays(c.mesh, 400, 2);
    const RayHits hits = intersect(surface, c.mesh.positions, rays, {.all = true});
    for (size_t i = 0; i < rays.size(); ++i) {
      const auto begin = Eigen::Index(hits.first[i]), end = Eigen::Index(hits.first[i + 1]);
      ASSERT_EQ((end - begin) % 2, 0) << c.scheme << " " << i;
      for (Eigen::Index k = begin; k < end; ++k) {
        if (hits.normals.row(k).isZero(0)) continue;
        const double side = hits.normals.row(k) * rays[i].direction;
        EXPECT_EQ(side < 0, (k - begin) % 2 == 0) << c.scheme << " " << i;
      }
    }
  }
}

// Triangles within a proved distance are hit where the surface is, but for rays that graze.
TEST(Intersect, AreNearThoseOfTriangles) {
  const Mesh mesh = jittered(prism(5));
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const Tessellation t = tessellate(surface, mesh.positions, {.chord = 1e-4 * diagonal(mesh)});
  const std::vector<Ray> rays = random_rays(mesh, 100, 3);
  const RayHits hits = intersect(surface, mesh.positions, rays, {.all = true});
  for (size_t i = 0; i < rays.size(); ++i) {
    int count = 0;
    bool grazes = false;
    for (const Tessellation::Triangle& triangle : t.triangles) {
      Eigen::Matrix3d M;
      const auto p = [&](size_t k) { return Eigen::Vector3d(t.points.row(triangle.vertices[k])); };
      M << p(1) - p(0), p(2) - p(0), -rays[i].direction;
      const Eigen::Vector3d x = M.inverse() * (rays[i].origin - p(0));
      count += x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] >= 0;
      const Eigen::Vector3d n = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
      if (x[0] >= -0.1 && x[1] >= -0.1 && x[0] + x[1] <= 1.1)
        grazes |= std::abs(n.dot(rays[i].direction.normalized())) < 0.05;
    }
    if (!grazes) {
      EXPECT_EQ(hits.first[i + 1] - hits.first[i], count) << i;
    }
  }
}

// Rays through vertices, middles of edges and points of edges meet one side.
TEST(Intersect, RaysThroughEdgesAndVerticesHitOnce) {
  for (const Case& c : closed_cases()) {
    const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
    std::vector<Place> at;
    const bool triangles = surface.faces().triangles;
    for (Index f = 0; f < surface.faces().size; ++f)
      for (const auto& [u, v] : std::vector<std::pair<double, double>>{{0, 0}, {0.5, 0}, {0.3, 0}, {0, 0.7}, {1, 0}})
        at.push_back({f, u, v});
    if (!triangles)
      for (Index f = 0; f < surface.faces().size; ++f) at.push_back({f, 1, 1});
    const LimitSamples s = surface.evaluate(c.mesh.positions, at, 1);
    std::vector<Ray> rays;
    for (Eigen::Index i = 0; i < s.position.rows(); ++i) {
      if (s.normal.row(i).isZero(0)) continue;
      rays.push_back({Eigen::Vector3d(s.position.row(i) + 0.01 * s.normal.row(i)), -s.normal.row(i), 0, 0.02});
    }
    const RayHits hits = intersect(surface, c.mesh.positions, rays, {.all = true});
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(hits.first[i + 1] - hits.first[i], 1) << c.scheme << " " << i;
      if (hits.first[i + 1] > hits.first[i]) {
        EXPECT_NEAR(hits.t[size_t(hits.first[i])], 0.01, found_hit) << c.scheme << " " << i;
      }
    }
  }
}

// Far from the origin as near it: in and out in turn, and through edges once.
TEST(Intersect, MissesNothingFarFromTheOrigin) {
  for (const double offset : {1e3, 1e6}) {
    Mesh mesh = jittered(prism(5));
    std::vector<Ray> rays = random_rays(mesh, 300, 8);
    mesh.positions.array() += offset;
    for (Ray& ray : rays) ray.origin.array() += offset;
    const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
    const RayHits hits = intersect(surface, mesh.positions, rays, {.all = true});
    for (size_t i = 0; i < rays.size(); ++i)
      EXPECT_EQ((hits.first[i + 1] - hits.first[i]) % 2, 0) << offset << " " << i;
    std::vector<Place> at;
    for (Index f = 0; f < surface.faces().size; ++f)
      for (const auto& [u, v] : std::vector<std::pair<double, double>>{{0, 0}, {0.5, 0}, {0.3, 0}, {0, 0.7}, {1, 1}})
        at.push_back({f, u, v});
    const LimitSamples s = surface.evaluate(mesh.positions, at, 1);
    std::vector<Ray> down;
    for (Eigen::Index i = 0; i < s.position.rows(); ++i)
      down.push_back({Eigen::Vector3d(s.position.row(i) + 0.01 * s.normal.row(i)), -s.normal.row(i), 0, 0.02});
    const RayHits edges = intersect(surface, mesh.positions, down, {.all = true});
    for (size_t i = 0; i < down.size(); ++i) EXPECT_EQ(edges.first[i + 1] - edges.first[i], 1) << offset << " " << i;
  }
}

TEST(Intersect, NearestIsTheFirstOfAll) {
  const Mesh mesh = torus(7, 5);
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  std::vector<Ray> rays = random_rays(mesh, 300, 4);
  const RayHits all = intersect(surface, mesh.positions, rays, {.all = true}),
                nearest = intersect(surface, mesh.positions, rays);
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(nearest.first[i + 1] - nearest.first[i], std::min<std::int64_t>(1, all.first[i + 1] - all.first[i]));
    if (nearest.first[i + 1] > nearest.first[i]) {
      EXPECT_EQ(nearest.t[size_t(nearest.first[i])], all.t[size_t(all.first[i])]);
    }
  }
  // Between the first hit and the second one, and from inside.
  for (size_t i = 0; i < rays.size(); ++i)
    if (all.first[i + 1] - all.first[i] >= 2) {
      rays[i].tmin = (all.t[size_t(all.first[i])] + all.t[size_t(all.first[i]) + 1]) / 2;
      const RayHits later = intersect(surface, mesh.positions, {rays[i]});
      ASSERT_EQ(later.t.size(), 1u);
      EXPECT_NEAR(later.t[0], all.t[size_t(all.first[i]) + 1], found_distance);
      break;
    }
}

// One ray after another as all together; and those of the addresses, each alone, together.
TEST(RayTracer, FindsWhatIntersectFinds) {
  for (const Case& c : closed_cases()) {
    const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
    const RayTracer tracer(surface, c.mesh.positions);
    const std::vector<Ray> rays = random_rays(c.mesh, 100, 6);
    const RayHits all = intersect(surface, c.mesh.positions, rays, {.all = true});
    for (size_t i = 0; i < rays.size(); ++i) {
      std::int64_t undecided = -1;
      const std::vector<RayHit> hits = tracer.trace(rays[i], {.all = true}, {}, &undecided);
      EXPECT_EQ(undecided, all.undecided[i]);
      ASSERT_EQ(std::ssize(hits), all.first[i + 1] - all.first[i]) << c.scheme << " " << i;
      for (size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(hits[k].t, all.t[size_t(all.first[i]) + k]);
        const std::vector<RayHit> own = tracer.trace(rays[i], {.all = true}, hits[k].place.face);
        EXPECT_TRUE(std::ranges::any_of(own, [&](const RayHit& h) { return h.t == hits[k].t; }))
            << c.scheme << " " << i;
      }
      size_t of_addresses = 0;
      for (Index a = 0; a < surface.addresses().size(); ++a)
        of_addresses += tracer.trace(rays[i], {.all = true}, a).size();
      EXPECT_GE(of_addresses, hits.size()) << c.scheme << " " << i;
    }
  }
}

TEST(RayTracer, RefusesInClearWords) {
  const Mesh mesh = cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const RayTracer tracer(surface, mesh.positions);
  EXPECT_THROW(tracer.trace({{0, 0, 0}, {0, 0, 0}}), InvalidParameter);
  EXPECT_THROW(tracer.trace({{0, 0, 0}, {0, 0, 1}}, {}, -1), InvalidParameter);
  EXPECT_THROW(tracer.trace({{0, 0, 0}, {0, 0, 1}}, {}, 6), InvalidParameter);
}

TEST(Intersect, AxesOfABoxAreExact) {
  const Mesh box = cube();  // [-1,1]^3
  const LimitMap surface(find_scheme("bilinear").value(), box);
  const std::vector<Ray> rays{
      {{0.25, 0.5, -3}, {0, 0, 2}}, {{0, 0, 0}, {1, 0, 0}}, {{5, 5, 5}, {1, 1, 1}}, {{0.1, 0.2, 5}, {0, 0, -1}, 0, 1}};
  const RayHits hits = intersect(surface, box.positions, rays, {.all = true});
  ASSERT_EQ(hits.first, (std::vector<std::int64_t>{0, 2, 3, 3, 3}));
  EXPECT_NEAR(hits.t[0], 1, rounding(4));
  EXPECT_NEAR(hits.t[1], 2, rounding(4));
  EXPECT_NEAR(hits.t[2], 1, rounding(4));
}

TEST(Intersect, LeavesHolesOutAndTakesOpenSurfaces) {
  Mesh holed = cube();
  const LimitMap whole(find_scheme("bilinear").value(), holed);
  const Ray up{{0.25, 0.5, -3}, {0, 0, 1}};
  EXPECT_EQ(intersect(whole, holed.positions, {up}, {.all = true}).t.size(), 2u);
  const Index face = intersect(whole, holed.positions, {up}).places[0].face;
  holed.holes = {face};
  const LimitMap with_hole(find_scheme("bilinear").value(), holed);
  EXPECT_EQ(intersect(with_hole, holed.positions, {up}, {.all = true}).t.size(), 1u);
  const Mesh open = grid(3, 2);
  const LimitMap sheet(find_scheme("catmull-clark").value(), open);
  EXPECT_EQ(intersect(sheet, open.positions, {{{1.3, 0.8, 9}, {0, 0, -1}}}, {.all = true}).t.size(), 1u);
}

// Also next to the borders of dual schemes, whose pieces there have no place in an address.
TEST(Intersect, PlacesOfOpenSurfacesAreOnTheRay) {
  for (const char* scheme : {"catmull-clark", "doo-sabin", "mid-edge", "averaging"}) {
    const Mesh open = jittered(grid(4, 4));
    const LimitMap surface(find_scheme(scheme).value(), open);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> across(0, 4);
    std::vector<Ray> rays;
    for (int i = 0; i < 300; ++i) rays.push_back({{across(random), across(random), 5}, {0, 0, -1}});
    const RayHits hits = intersect(surface, open.positions, rays);
    EXPECT_GT(hits.t.size(), 100u) << scheme;
    const Points at = surface.evaluate(open.positions, hits.places).position;
    for (size_t i = 0; i < rays.size(); ++i)
      for (auto k = Eigen::Index(hits.first[i]); k < Eigen::Index(hits.first[i + 1]); ++k) {
        const Eigen::Vector3d on_ray = rays[i].origin + hits.t[size_t(k)] * rays[i].direction;
        EXPECT_LE((at.row(k).transpose() - on_ray).norm(), found_hit * diagonal(open)) << scheme << " " << i;
      }
  }
}

// A ray that touches has one hit, which says that it is not decided; a little off it has none, or two.
TEST(Intersect, TangentRaysHitOnceOrTwiceOrNot) {
  const Mesh mesh = cube();  // its limit is convex
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const std::vector<Place> at = random_places(surface.addresses(), 60, 3);
  const LimitSamples on = surface.evaluate(mesh.positions, at, 1);
  const double size = diagonal(mesh);
  const auto tangents = [&](double off) {
    std::vector<Ray> rays;
    for (Eigen::Index i = 0; i < on.position.rows(); ++i) {
      const Eigen::RowVector3d along =
          (std::cos(double(i)) * on.du.row(i) + std::sin(double(i)) * on.dv.row(i)).normalized();
      rays.push_back({on.position.row(i) - 3 * along + off * size * on.normal.row(i), along});
    }
    return rays;
  };
  const RayHits touching = intersect(surface, mesh.positions, tangents(0), {.all = true});
  for (size_t i = 0; i < at.size(); ++i) {
    ASSERT_EQ(touching.first[i + 1] - touching.first[i], 1) << i;
    EXPECT_GT(touching.undecided[i], 0) << i;
    EXPECT_NEAR(touching.t[size_t(touching.first[i])], 3, found_touch * size) << i;
  }
  for (const double off : {1e-3, 1e-6, 1e-9}) {
    const RayHits outside = intersect(surface, mesh.positions, tangents(off), {.all = true}),
                  inside = intersect(surface, mesh.positions, tangents(-off), {.all = true});
    for (size_t i = 0; i < at.size(); ++i) {
      EXPECT_EQ(outside.first[i + 1] - outside.first[i], 0) << off << " " << i;
      EXPECT_EQ(inside.first[i + 1] - inside.first[i], 2) << off << " " << i;
      EXPECT_EQ(outside.undecided[i] + inside.undecided[i], 0) << off << " " << i;
    }
  }
}

// In a face or along an edge a ray has no end of hits: the first one is told, and that there is more.
TEST(Intersect, RaysInTheSurfaceTellWhereTheyEnterIt) {
  const Mesh box = cube();  // [-1, 1]^3
  const LimitMap surface(find_scheme("bilinear").value(), box);
  const std::vector<Ray> rays{{{-3, 1, 1}, {1, 0, 0}}, {{-3, 0.3, 1}, {1, 0, 0}}, {{-3, -3, 1}, {1, 1, 0}}};
  const RayHits hits = intersect(surface, box.positions, rays);
  ASSERT_EQ(hits.t.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(hits.t[i], 2, found_touch * diagonal(box));
    EXPECT_GT(hits.undecided[i], 0);
  }
}

/// A pyramid over a regular n-gon, its apex (0, 0, 1) a sharp corner.
Mesh sharp_pyramid(Index n) {
  std::vector<Eigen::Vector3d> x{{0, 0, 1}};
  std::vector<std::vector<Index>> faces;
  std::vector<Index> base;
  for (Index i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    x.push_back({std::cos(angle), std::sin(angle), 0});
    faces.push_back({0, 1 + i, 1 + (i + 1) % n});
    base.insert(base.begin(), 1 + i);
  }
  faces.push_back(base);
  Mesh mesh = make_mesh(x, faces);
  mesh.corners.push_back({0, 10});
  return mesh;
}

// A sharp corner is the vertex itself. Along the axis a ray meets the base behind it. (Of few faces the limit is a
// needle there, which a ray at an angle leaves again.)
TEST(Intersect, RaysThroughSharpApexesHitTheVertex) {
  for (const char* scheme : {"catmull-clark", "loop"})
    for (Index n = 3; n <= 8; ++n) {
      Mesh mesh = sharp_pyramid(n);
      if (std::string(scheme) == "loop") mesh = triangulated(mesh);
      const LimitMap surface(find_scheme(scheme).value(), mesh);
      std::vector<Ray> rays;
      for (const Eigen::Vector3d& along : {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.05, 0.02, -1).normalized()})
        rays.push_back({Eigen::Vector3d(0, 0, 1) - 4 * along, along});
      for (const bool all : {false, true}) {
        const RayHits hits = intersect(surface, mesh.positions, rays, {.all = all});
        for (size_t i = 0; i < rays.size(); ++i) {
          ASSERT_GT(hits.first[i + 1], hits.first[i]) << scheme << " " << n;
          EXPECT_NEAR(hits.t[size_t(hits.first[i])], 4, same_hit) << scheme << " " << n;
        }
        EXPECT_EQ(hits.first[1], all ? 2 : 1) << scheme << " " << n;
      }
    }
}

// The plane x + y + z = 1 at angles down to some 0.005 degrees, after few parts.
TEST(Intersect, GrazingRaysHitATriangle) {
  const Mesh triangle = make_mesh({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
  const Eigen::Vector3d normal = Eigen::Vector3d::Ones().normalized(), middle = Eigen::Vector3d::Constant(1. / 3);
  for (const char* scheme : {"bilinear", "catmull-clark", "loop"}) {
    const LimitMap surface(find_scheme(scheme).value(), triangle);
    std::vector<Ray> rays;
    std::mt19937 random(21);
    std::uniform_real_distribution<double> angles(0, 2 * M_PI), offsets(-0.08, 0.08);
    for (const double slope : {1e-2, 1e-3, 1e-4, 1e-5})
      for (int i = 0; i < 25; ++i) {
        const double a = angles(random);
        const Eigen::Vector3d x = Eigen::Vector3d(1, -1, 0).normalized(), y = normal.cross(x);
        const Eigen::Vector3d at = middle + offsets(random) * x + offsets(random) * y;
        rays.push_back({at, std::cos(a) * x + std::sin(a) * y + slope * normal, -1});
        rays.back().origin -= rays.back().direction;
        rays.back().tmin = 0;
      }
    const RayHits hits = intersect(surface, triangle.positions, rays, {.all = true, .most_parts = 500});
    for (size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(hits.first[i + 1] - hits.first[i], 1) << scheme << " " << i;
      const auto hit = size_t(hits.first[i]);
      EXPECT_EQ(hits.kinds[hit], HitKind::crossing) << scheme << " " << i;
      EXPECT_NEAR(hits.t[hit], 1, found_grazing) << scheme << " " << i;
    }
  }
}

// A ray that is given up says so, where it stopped, and keeps what was found.
TEST(Intersect, RaysThatAreGivenUpSaySo) {
  const Mesh mesh = jittered(cube());
  const LimitMap surface(find_scheme("kobbelt").value(), mesh);
  const std::vector<Ray> rays = random_rays(mesh, 40, 23);
  const RayHits all = intersect(surface, mesh.positions, rays, {.all = true}),
                short_of = intersect(surface, mesh.positions, rays, {.all = true, .most_parts = 1});
  int given_up = 0;
  for (size_t i = 0; i < rays.size(); ++i)
    for (auto k = size_t(short_of.first[i]); k < size_t(short_of.first[i + 1]); ++k) {
      if (short_of.kinds[k] != HitKind::given_up) continue;
      ++given_up;
      EXPECT_STREQ(short_of.word(std::int64_t(k)), "given-up");
      EXPECT_EQ(short_of.status[k], LimitStatus::outside);
      EXPECT_GT(short_of.undecided[i], 0);
      EXPECT_TRUE(short_of.normals.row(Eigen::Index(k)).isZero(0));
      const Eigen::Vector3d on_ray = rays[i].origin + short_of.t[k] * rays[i].direction;
      EXPECT_EQ(Eigen::Vector3d(short_of.points.row(Eigen::Index(k))), on_ray);
      // No hit lies before it that was not found.
      for (auto hit = size_t(all.first[i]); hit < size_t(all.first[i + 1]); ++hit) {
        if (all.t[hit] >= short_of.t[k]) continue;
        EXPECT_TRUE(std::any_of(short_of.t.begin() + short_of.first[i], short_of.t.begin() + short_of.first[i + 1],
                                [&](double t) { return std::abs(t - all.t[hit]) <= found_hit * diagonal(mesh); }));
      }
    }
  EXPECT_GT(given_up, 0);
  EXPECT_EQ(std::ranges::count(all.kinds, HitKind::given_up), 0);
}

TEST(Intersect, HasTheSameBitsForAnyNumberOfThreads) {
  const Mesh mesh = jittered(prism(5));
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const std::vector<Ray> rays = random_rays(mesh, 300, 5);
  const RayHits a = intersect(surface, mesh.positions, rays, {.all = true});
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const RayHits b = intersect(surface, mesh.positions, rays, {.all = true});
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.first, b.first);
}

TEST(Intersect, RefusesInClearWords) {
  const Mesh mesh = cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  EXPECT_THROW(intersect(surface, mesh.positions, {{{0, 0, 0}, {0, 0, 0}}}), InvalidParameter);
  EXPECT_THROW(intersect(surface, mesh.positions, {{{0, 0, std::nan("")}, {0, 0, 1}}}), InvalidParameter);
  EXPECT_THROW(intersect(surface, mesh.positions, {{{0, 0, 0}, {0, 0, HUGE_VAL}}}), InvalidParameter);
  EXPECT_THROW(intersect(surface, mesh.positions, {{{0, 0, 0}, {0, 0, 1}, 2, 1}}), InvalidParameter);
  EXPECT_THROW(intersect(surface, mesh.positions, {{{0, 0, 1e155}, {0, 0, 1}}}), InvalidParameter);
  EXPECT_THROW(intersect(surface, mesh.positions, {}, {.most_parts = 0}), InvalidParameter);
  EXPECT_TRUE(intersect(surface, mesh.positions, {}).t.empty());
  Mesh nothing;
  nothing.positions = Points::Zero(0, 3);
  EXPECT_TRUE(
      intersect(LimitMap(find_scheme("loop").value(), nothing), nothing.positions, {{{0, 0, 0}, {0, 0, 1}}}).t.empty());
}

}  // namespace
}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
// Evaluation: points of the surface are stencils times points, whichever way they are computed and by how many threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>

#include <cstring>
#include <random>
#include <thread>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/limit.h"
#include "sublimit/scheme/scheme_info.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_surface.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Sine of the angle between tangents: below it rounding alone may turn their product by more than reference_angle.
constexpr double nearly_parallel = 1e-6;

constexpr Points LimitSamples::*quantities[] = {&LimitSamples::position, &LimitSamples::du,  &LimitSamples::dv,
                                                &LimitSamples::duu,      &LimitSamples::duv, &LimitSamples::dvv};

/// Inside, on edges, at corners and near them.
std::vector<Place> some_places(const LimitMap& surface, int count, unsigned seed) {
  const Topology& t = surface.level().topology();
  std::vector<Place> result;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  while (int(result.size()) < count) {
    const HalfEdge h{Index(random() % std::uint32_t(t.num_half_edges()))};
    Place s{Index(random() % std::uint32_t(surface.addresses().size())), unit(random), unit(random)};
    if (surface.addresses().triangles() && s.u + s.v > 1) s.u = 1 - s.u, s.v = 1 - s.v;
    const double d = std::ldexp(1.0, -int(random() % 20));
    switch (random() % 8) {
      case 0:
        s = on_edge(t, surface.addresses(), h, unit(random));
        break;
      case 1:
        s = from_corner(t, surface.addresses(), h, 0, 0);
        break;
      case 2:
        s = from_corner(t, surface.addresses(), h, d / 2, d / 4);
        break;
      default:
        break;
    }
    result.push_back(s);
  }
  return result;
}

bool same_bits(const Points& a, const Points& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(), sizeof(double) * size_t(a.size())) == 0);
}

bool same_bits(const LimitSamples& a, const LimitSamples& b) {
  for (const auto quantity : quantities)
    if (!same_bits(a.*quantity, b.*quantity)) return false;
  return same_bits(a.normal, b.normal) && a.status == b.status && a.order == b.order;
}

class LimitSurfaceEvaluation : public ::testing::TestWithParam<TestedScheme> {
 protected:
  void SetUp() override {
    scheme_ = GetParam().scheme();
    mesh_ = hard_meshes(scheme_, 4).back();
    surface_ = std::make_unique<LimitMap>(scheme_, mesh_);
    // So many that patches are bound: half of them are the same again.
    const int few = std::max(30, 300 / effort(scheme_));
    few_ = some_places(*surface_, few, 1);
    const size_t enough = 4 * size_t(surface_->level().topology().num_half_edges()) + 4000;
    while (many_.size() < enough) many_.insert(many_.end(), few_.begin(), few_.end());
  }
  Scheme<double> scheme_;
  Mesh mesh_;
  std::unique_ptr<LimitMap> surface_;
  std::vector<Place> few_, many_;
};

TEST_P(LimitSurfaceEvaluation, IsStencilsTimesPointsByBothPaths) {
  const double box = diagonal(mesh_.positions);
  for (int order = 0; order <= 2; ++order) {
    const LimitSamples few = surface_->evaluate(mesh_.positions, few_, order),
                       many = surface_->evaluate(mesh_.positions, many_, order);
    ASSERT_EQ(few.status.size(), few_.size());
    ASSERT_EQ(many.status.size(), many_.size());
    for (Index i = 0; i < Index(few_.size()); ++i) {
      const Place& s = few_[size_t(i)];
      SCOPED_TRACE("square " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " + std::to_string(s.v) +
                   ") order " + std::to_string(order));
      const LimitStencil stencil = surface_->stencil(s, order);
      Points local(Index(stencil.vertices.size()), 3);
      for (Index j = 0; j < local.rows(); ++j) local.row(j) = mesh_.positions.row(stencil.vertices[size_t(j)]);
      const Points rows = stencil.weights * local;
      for (const LimitSamples* samples : {&few, &many}) {
        EXPECT_EQ(int(samples->order[size_t(i)]), rows.rows() == 6 ? 2 : rows.rows() == 3 ? 1 : 0);
        if (samples->status[size_t(i)] != LimitStatus::undefined_normal) {
          EXPECT_EQ(samples->status[size_t(i)], stencil.status);
        }
        double size = box;  // of the derivatives of an order
        for (int k = 0; k < rows.rows(); ++k) {
          if (k == 1) size = box + rows.middleRows(1, 2).rowwise().norm().maxCoeff();
          if (k == 3) size = size + rows.middleRows(3, 3).rowwise().norm().maxCoeff();
          const Eigen::RowVector3d row = (samples->*quantities[k]).row(i);
          EXPECT_LE((row - rows.row(k)).norm(), (k < 3 ? eigen(10) : eigen(1000)) * size) << "row " << k;
        }
        for (Eigen::Index k = rows.rows(); k < (order == 2 ? 6 : order == 1 ? 3 : 1); ++k)
          EXPECT_TRUE((samples->*quantities[k]).row(i).isZero(0)) << "an absent row " << k;
        if (order == 0) {
          EXPECT_EQ(samples->normal.rows(), 0);
          continue;
        }
        const Eigen::Vector3d normal = samples->normal.row(i);
        EXPECT_EQ(normal.isZero(0), samples->status[size_t(i)] == LimitStatus::undefined_normal);
        if (normal.isZero(0)) continue;
        EXPECT_LE(std::abs(normal.norm() - 1), rounding(4));
        EXPECT_LE((normal - Eigen::Vector3d(few.normal.row(i))).norm(), reference_angle);
        if (rows.rows() < 3) continue;
        const Eigen::Vector3d du = rows.row(1), dv = rows.row(2);
        if (du.cross(dv).norm() > nearly_parallel * du.norm() * dv.norm()) {
          EXPECT_LE((normal - du.cross(dv).normalized()).norm(), reference_angle);
        }
      }
    }
  }
}

TEST_P(LimitSurfaceEvaluation, HasTheSameBitsWithAnyNumberOfThreads) {
  const auto all = [&] {
    const LimitMap fresh(scheme_, mesh_);
    return std::pair(fresh.evaluate(mesh_.positions, many_, 2), fresh.evaluate(mesh_.positions, few_, 1));
  };
  const auto parallel = all();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = all();
  EXPECT_TRUE(same_bits(parallel.first, alone.first));
  EXPECT_TRUE(same_bits(parallel.second, alone.second));
}

TEST_P(LimitSurfaceEvaluation, BoundPointsGiveTheSame) {
  const LimitSurface bound(*surface_, mesh_.positions);
  LimitSamples kept;
  for (const int order : {2, 0, 1}) {
    const LimitSamples expected = surface_->evaluate(mesh_.positions, many_, order);
    EXPECT_TRUE(same_bits(bound.evaluate(many_, order), expected));
    bound.evaluate(many_, order, true, kept);
    EXPECT_TRUE(same_bits(kept, expected));
    bound.evaluate(many_, order, false, kept);
    EXPECT_EQ(kept.normal.rows(), 0);
    // Rows without a clear normal take the other way only where normals are wanted.
    const double tolerance = eigen(10) * diagonal(mesh_.positions);
    EXPECT_LE((kept.position - expected.position).cwiseAbs().maxCoeff(), tolerance);
  }
}

TEST_P(LimitSurfaceEvaluation, TypesAreSharedBetweenSurfacesAndThreads) {
  const auto types = std::make_shared<LimitCache>(scheme_);
  const LimitSamples expected = surface_->evaluate(mesh_.positions, few_, 2);
  std::vector<LimitSamples> found(3);
  std::vector<std::thread> threads;
  for (LimitSamples& samples : found)
    threads.emplace_back([&] {
      const LimitMap own(scheme_, mesh_, {}, types);
      samples = own.evaluate(mesh_.positions, few_, 2);
    });
  for (std::thread& thread : threads) thread.join();
  for (const LimitSamples& samples : found) EXPECT_TRUE(same_bits(samples, expected));
  const size_t known = types->pieces().size();
  EXPECT_GT(known, 1u);
  const LimitMap again(scheme_, mesh_, {}, types);
  EXPECT_TRUE(same_bits(again.evaluate(mesh_.positions, few_, 2), expected));
  EXPECT_EQ(types->pieces().size(), known);
}

// Degrees from 4 on have large types and nothing of their own here.
INSTANTIATE_TEST_SUITE_P(Schemes, LimitSurfaceEvaluation, ::testing::ValuesIn(schemes_and_degrees(3)), test_name);

TEST(PieceTypes, ThatAreFullLeaveASurfaceToItself) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const Mesh mesh = hard_polygons(1);
  const auto small = std::make_shared<LimitCache>(scheme, 5);
  const LimitMap own(scheme, mesh), first(scheme, mesh, {}, small);
  const std::vector<Place> places = some_places(own, 100, 3);
  const LimitSamples expected = own.evaluate(mesh.positions, places, 2);
  EXPECT_TRUE(same_bits(first.evaluate(mesh.positions, places, 2), expected));
  EXPECT_TRUE(small->pieces().is_full());
  const size_t size = small->pieces().size();
  const LimitMap second(scheme, hard_polygons(3), {}, small);
  second.prepare();
  EXPECT_EQ(small->pieces().size(), size);
}

TEST(LimitMap, PlacesOutsideAreRowsOfTheirOwn) {
  const Mesh mesh = cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  std::vector<Place> samples{{0, 0.5, 0.5}, {-1, 0, 0},  {6, 0, 0},   {0, -1e-300, 0}, {0, 1 + eps, 0},
                             {0, nan, 0.5}, {0, 0, nan}, {0, inf, 0}, {5, 1, 1}};
  for (const bool bound : {false, true}) {
    if (bound) samples.resize(100, samples[1]);
    const LimitSamples out = surface.evaluate(mesh.positions, samples, 1);
    for (size_t i = 0; i < samples.size(); ++i) {
      const bool inside = i == 0 || i == 8;
      EXPECT_EQ(out.status[i] == LimitStatus::outside, !inside) << i;
      if (!inside) {
        EXPECT_TRUE(out.position.row(Index(i)).isZero(0) && out.normal.row(Index(i)).isZero(0));
        EXPECT_EQ(out.order[i], 0);
      }
    }
  }
}

TEST(LimitMap, NoSamplesAreNoRows) {
  const LimitMap surface(find_scheme("loop").value(), octahedron());
  EXPECT_EQ(surface.evaluate(octahedron().positions, {}, 2).position.rows(), 0);
}

TEST(LimitMap, BadRequestsAreErrors) {
  const Mesh mesh = cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error<InvalidParameter>([&] { surface.stencil({6, 0, 0}); }, {"face 6", "faces are 0 to 5"});
  expect_error<InvalidParameter>([&] { surface.stencil({-1, 0, 0}); }, {"face -1"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 1.5, 0}); }, {"1.5", "outside the square"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 0, -0.25}); }, {"-0.25", "outside"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, nan, 0}); }, {"nan"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 0, 0}, 3); }, {"order 3"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 0, 0}, -1); }, {"order -1"});
  const std::vector<Place> one{{0, 0, 0}};
  expect_error<InvalidParameter>([&] { surface.evaluate(mesh.positions, one, 3); }, {"order 3"});
  expect_error<InvalidParameter>([&] { surface.evaluate(Points::Zero(7, 3), one); }, {"7 x 3", "8 x 3"});
  expect_error<InvalidParameter>([&] { LimitSurface(surface, Points::Zero(9, 3)); }, {"9 x 3", "8 x 3"});
  expect_error<InvalidParameter>([&] { LimitSurface(surface, mesh.positions).evaluate(one, 3); }, {"order 3"});
  expect_error<InvalidParameter>([&] { surface.grid(1); }, {"grid of 1"});
  const LimitMap triangles(find_scheme("loop").value(), octahedron());
  expect_error<InvalidParameter>([&] { triangles.stencil({0, 0.75, 0.5}); }, {"outside the triangle"});
  expect_error<InvalidParameter>([&] { triangles.stencil({8, 0, 0}); }, {"face 8", "the triangles"});
}

TEST(LimitMap, RotatingSchemesBeginWithEvenLevels) {
  for (const char* name : {"sqrt3", "interpolatory-sqrt3"}) {
    const Scheme<double> scheme = find_scheme(name).value();
    const std::vector<Level> levels = refine(scheme, octahedron(), 2);
    expect_error<InvalidParameter>([&] { LimitMap(scheme, levels[1]); }, {name, "multiple of 2", "level 1"});
    EXPECT_NO_THROW(LimitMap(scheme, levels[2]).stencil({0, 0.25, 0.25}));
  }
}

// Limits refine parts of a mesh, whose faces have numbers of their own: the message has that of the mesh.
TEST(LimitMap, NamesTheFirstFaceThatIsNoTriangle) {
  Mesh mesh;  // a row of triangles, and a quadrilateral behind them
  const Index triangles = 40;
  mesh.positions = Points::Zero(triangles + 4, 3);
  for (Index v = 0; v < triangles + 4; ++v) mesh.positions.row(v) << v / 2, v % 2, 0;
  for (Index f = 0; f < triangles; ++f) {
    mesh.face_sizes.push_back(3);
    for (const Index v : {f, f + 1 + (f % 2 == 0 ? 1 : 0), f + 2 - (f % 2 == 0 ? 1 : 0)})
      mesh.face_vertices.push_back(v);
  }
  mesh.face_sizes.push_back(4);
  for (const Index v : {triangles, triangles + 2, triangles + 3, triangles + 1}) mesh.face_vertices.push_back(v);
  size_t of_triangles = 0;
  for (const SchemeInfo& info : schemes()) {
    if (!info.triangles || !info.linear || info.kind != SchemeInfo::Kind::surface) continue;
    SCOPED_TRACE(info.name);
    ++of_triangles;
    const std::string where = "face " + std::to_string(triangles) + " has 4 corners";
    expect_error<UnsupportedTopology>([&] { (void)LimitMap(find_scheme(info.name).value(), mesh); }, {where});
    expect_error<UnsupportedTopology>([&] { (void)LimitSurface(mesh, info.name); }, {where});
    expect_error<UnsupportedTopology>([&] { (void)limit(mesh, info.name); }, {where});
  }
  EXPECT_GE(of_triangles, 3u);
}

TEST(LimitMap, PolygonsThatAreCutAtEdgesAreRefused) {
  expect_error<UnsupportedTopology>(
      [&] {
        LimitMap(find_scheme("kobbelt", {{"quads", "edges"}}).value(), hard_polygons(1));
      },
      {"kobbelt", "quads"});
}

TEST(LimitMap, GridsHaveAllEndsAndOrder) {
  const LimitMap quads(find_scheme("catmull-clark").value(), cube()),
      triangles(find_scheme("loop").value(), octahedron());
  const std::vector<Place> q = quads.grid(4), t = triangles.grid(4);
  ASSERT_EQ(q.size(), 6u * 16);
  ASSERT_EQ(t.size(), 8u * 10);
  EXPECT_EQ(q[17].face, 1);
  EXPECT_EQ(q[17].u, 1.0 / 3);  // u fastest
  EXPECT_EQ(q[17].v, 0);
  EXPECT_EQ(q[15].u, 1);
  EXPECT_EQ(q[15].v, 1);
  EXPECT_EQ(t[3].u, 1);
  EXPECT_EQ(t[4].v, 1.0 / 3);
  EXPECT_EQ(t[9].v, 1);
  for (const Place& s : t) EXPECT_NO_THROW(triangles.stencil(s));
  for (const int N : {2, 3, 7, 50, 100})
    for (const Place& s : triangles.grid(N)) EXPECT_TRUE(s.u >= 0 && s.v >= 0 && s.u + s.v <= 1) << N;
}

}  // namespace
}  // namespace sublimit::testing

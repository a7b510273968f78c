// SPDX-License-Identifier: Apache-2.0
// Tensor products: rows, refinement, statuses, spheres and tori against their closed forms, poles, and the limits of
// Catmull-Clark and Doo-Sabin on closed grids.
#include "sublimit/patches/spline_surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/source/curvature.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"

namespace sublimit::testing {
namespace {

SplineSurface random_surface(std::mt19937& random, int degree_u, int degree_v) {
  const bool u_closed = random() % 3 == 0, v_closed = random() % 3 == 0;
  return {random_knots<double>(random, degree_u, u_closed), random_knots<double>(random, degree_v, v_closed)};
}

Place random_place(std::mt19937& random, const SplineSurface& surface) {
  std::uniform_real_distribution<double> inside(0, 1);
  const auto parameter = [&] { return random() % 4 == 0 ? double(random() % 2) : inside(random); };
  return {static_cast<Index>(random() % surface.num_faces()), parameter(), parameter()};
}

Knots<double> circle_knots() { return Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}); }

/// A profile (r, z) with weights, turned about the z axis in four quarters: columns (cos X, sin X, omega Z, omega W).
Points revolved(const Points& profile) {
  const double s = std::sqrt(0.5);
  const double cosine[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, sine[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  Points columns(9 * profile.rows(), 4);
  for (Index j = 0; j < profile.rows(); ++j)
    for (Index i = 0; i < 9; ++i) {
      const double omega = i % 2 == 0 ? 1 : s;
      columns.row(9 * j + i) << omega * cosine[i] * profile(j, 0), omega * sine[i] * profile(j, 0),
          omega * profile(j, 1), omega * profile(j, 2);
    }
  return columns;
}

/// From the south pole to the north: two quarters of a circle.
SplineSurface unit_sphere() { return {circle_knots(), Knots<double>::open(2, 5, {0, 0, 0, 1, 1, 2, 2, 2})}; }
Points sphere_columns() {
  const double s = std::sqrt(0.5);
  Points profile(5, 3);
  profile << 0, -1, 1, s, -s, s, 1, 0, 1, s, s, s, 0, 1, 1;
  return revolved(profile);
}

std::vector<Place> grid(const SplineSurface& surface, int N) {
  std::vector<Place> samples;
  for (Index face = 0; face < surface.num_faces(); ++face)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) samples.push_back({face, i / (N - 1.0), j / (N - 1.0)});
  return samples;
}

TEST(SplineSurface, RowsAreProductsOfTheRowsOfCurves) {
  std::mt19937 random(20);
  constexpr int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int repeat = 0; repeat < 60; ++repeat) {
    const SplineSurface surface = random_surface(random, 1 + repeat % 9, 1 + int(random() % 9));
    const SplineCurve in_u(surface.u()), in_v(surface.v());
    const Place sample = random_place(random, surface);
    const LimitStencil stencil = surface.stencil(sample, 2);
    const CurveStencil u = in_u.stencil({sample.face % in_u.num_segments(), sample.u}, 2);
    const CurveStencil v = in_v.stencil({sample.face / in_u.num_segments(), sample.v}, 2);
    ASSERT_EQ(stencil.vertices.size(), u.unknowns.size() * v.unknowns.size());
    EXPECT_TRUE(std::ranges::is_sorted(stencil.vertices));
    for (size_t j = 0, at = 0; j < v.unknowns.size(); ++j)
      for (size_t i = 0; i < u.unknowns.size(); ++i, ++at) {
        EXPECT_EQ(stencil.vertices[at], u.unknowns[i] + in_u.num_points() * v.unknowns[j]);
        for (int r = 0; r < 6; ++r) {
          // Of a short closed spline several functions are one point: sums of products, or products of sums.
          const double product = u.weights(orders[r][0], Eigen::Index(i)) * v.weights(orders[r][1], Eigen::Index(j));
          EXPECT_NEAR(stencil.weights(r, Eigen::Index(at)), product, rounding(8) * (1 + std::abs(product)));
        }
      }
    EXPECT_EQ(stencil.tangents, stencil.weights.middleRows(1, 2));
    EXPECT_NEAR(stencil.weights.row(0).sum(), 1, rounding(20));
    EXPECT_EQ(stencil.status == LimitStatus::crease,
              u.status == LimitStatus::crease || v.status == LimitStatus::crease);
  }
}

TEST(SplineSurface, TransposedIsTheSame) {
  std::mt19937 random(21);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const SplineSurface surface = random_surface(random, 1 + int(random() % 5), 1 + int(random() % 5));
    const SplineSurface turned(surface.v(), surface.u());
    const Index nu = surface.u().num_points(), nv = surface.v().num_points();
    const Points x = random_points(random, nu * nv, 3);
    Points y(nu * nv, 3);
    for (Index j = 0; j < nv; ++j)
      for (Index i = 0; i < nu; ++i) y.row(j + nv * i) = x.row(i + nu * j);
    const Place s = random_place(random, surface);
    const Index fu = s.face % surface.u().num_faces(), fv = s.face / surface.u().num_faces();
    const Place t{.face = fv + surface.v().num_faces() * fu, .u = s.v, .v = s.u};
    const LimitSamples a = surface.evaluate(x, {&s, 1}, 2), b = turned.evaluate(y, {&t, 1}, 2);
    EXPECT_LE((a.position - b.position).norm(), rounding(20));
    EXPECT_LE((a.du - b.dv).norm(), other_route * (1 + a.du.norm()));
    EXPECT_LE((a.duv - b.duv).norm(), other_route * (1 + a.duv.norm()));
    EXPECT_LE((a.dvv - b.duu).norm(), other_route * (1 + a.dvv.norm()));
    EXPECT_LE((a.normal + b.normal).norm(), other_route);
  }
}

TEST(SplineSurface, FinerKnotsLeaveItAsItIs) {
  std::mt19937 random(22);
  for (int repeat = 0; repeat < 24; ++repeat) {
    const SplineSurface surface = random_surface(random, 1 + int(random() % 6), 1 + int(random() % 6));
    const Points x = random_points(random, surface.num_points(), 3);
    const SplineSurface both[] = {halved(surface),
                                  {elevated_knots(surface.u()), halved_knots(surface.v())},
                                  {clamped_knots(surface.u()), bezier_pieces(surface.v())}};
    for (const SplineSurface& fine : both) {
      const Points net = apply(refinement_matrix(surface, fine), x);
      for (int k = 0; k < 8; ++k) {
        const Place s = random_place(random, fine), coarse = surface.place(fine.parameters(s));
        EXPECT_LE((fine.evaluate(net, {&s, 1}).position - surface.evaluate(x, {&coarse, 1}).position).norm(),
                  reference);
      }
    }
    // Insertions in u and in v commute.
    const SplineSurface in_u(halved_knots(surface.u()), surface.v()), in_v(surface.u(), halved_knots(surface.v()));
    const SparseMatrix at_once = refinement_matrix(surface, halved(surface));
    for (const SplineSurface& first : {in_u, in_v})
      EXPECT_LE(
          SparseMatrix(product(refinement_matrix(first, halved(surface)), refinement_matrix(surface, first)) - at_once)
              .norm(),
          reference);
  }
}

TEST(SplineSurface, SphereIsRoundWithItsNormalsAndCurvatureAndPoles) {
  const SplineSurface sphere = unit_sphere();
  const Points columns = sphere_columns();
  const std::vector<Place> samples = grid(sphere, 9);
  const LimitSamples at = sphere.evaluate(columns, samples, 2, Coordinates::homogeneous);
  double radius = 0, turn = 0;
  for (Index i = 0; i < std::ssize(samples); ++i) {
    const Eigen::RowVector3d x = at.position.row(i), u = at.du.row(i), v = at.dv.row(i);
    radius = std::max(radius, std::abs(x.norm() - 1));
    turn = std::max(turn, (at.normal.row(i) - x).norm());
    // x.x = 1, derived once and twice.
    EXPECT_LE(std::abs(x.dot(u)) + std::abs(x.dot(v)), rounding(16));
    EXPECT_NEAR(x.dot(at.duu.row(i)) + u.dot(u), 0, rounding(64));
    EXPECT_NEAR(x.dot(at.duv.row(i)) + u.dot(v), 0, rounding(64));
    EXPECT_NEAR(x.dot(at.dvv.row(i)) + v.dot(v), 0, rounding(64));
    const std::optional<Curvature> k = curvature(at, i);
    const bool pole = std::abs(x[2]) > 1 - 1e-9;
    EXPECT_EQ(k.has_value(), !pole) << i;
    if (k) {
      EXPECT_NEAR(k->gauss, 1, rounding(256));
    }
    if (k) {
      EXPECT_NEAR(k->mean, -1, rounding(256));
    }
  }
  EXPECT_LE(radius, rounding(3));
  EXPECT_LE(turn, rounding(16));
  RecordProperty("radius", std::to_string(radius / eps));
  // Near the poles too.
  for (const double v : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const Place near[] = {{1, 0.3, v}, {6, 0.3, 1 - v}};
    const LimitSamples there = sphere.evaluate(columns, near, 1, Coordinates::homogeneous);
    EXPECT_LE((there.normal - there.position).norm(), reference_angle) << v;
  }
}

TEST(SplineSurface, TorusIsTheClosedForm) {
  const double s = std::sqrt(0.5);
  const double cosine[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, sine[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  Points profile(9, 3);
  for (Index j = 0; j < 9; ++j) {
    const double w = j % 2 == 0 ? 1 : s;
    profile.row(j) << w * (3 + cosine[j]), w * sine[j], w;
  }
  const SplineSurface torus(circle_knots(), circle_knots());
  const Points columns = revolved(profile);
  const std::vector<Place> samples = grid(torus, 7);
  const LimitSamples at = torus.evaluate(columns, samples, 2, Coordinates::homogeneous);
  for (Index i = 0; i < std::ssize(samples); ++i) {
    const double x = at.position(i, 0), y = at.position(i, 1), z = at.position(i, 2), r = std::hypot(x, y);
    EXPECT_NEAR(std::hypot(r - 3, z), 1, rounding(8, 4));
    const Eigen::RowVector3d outward((r - 3) * x / r, (r - 3) * y / r, z);
    EXPECT_LE((at.normal.row(i) - outward).norm(), rounding(32, 4));
    const std::optional<Curvature> k = curvature(at, i);
    ASSERT_TRUE(k.has_value());
    EXPECT_NEAR(k->gauss, (r - 3) / r, rounding(256, 4));
  }
  // Equal angles at half parameters.
  for (int m = 0; m < 8; ++m) {
    const Place place = torus.place({.u = m / 2.0, .v = 0});
    const LimitSamples there = torus.evaluate(columns, {&place, 1}, 0, Coordinates::homogeneous);
    EXPECT_NEAR(there.position(0, 0), 4 * std::cos(m * std::numbers::pi / 4), rounding(8, 4));
    EXPECT_NEAR(there.position(0, 1), 4 * std::sin(m * std::numbers::pi / 4), rounding(8, 4));
  }
}

TEST(SplineSurface, RationalFinerKnotsLeaveTheSphereAsItIs) {
  const SplineSurface sphere = unit_sphere(), fine = halved(halved(sphere));
  const Points columns = apply(refinement_matrix(sphere, fine), sphere_columns());
  for (const Place& s : grid(fine, 3)) {
    const Place coarse = sphere.place(fine.parameters(s));
    EXPECT_LE((fine.evaluate(columns, {&s, 1}, 0, Coordinates::homogeneous).position -
               sphere.evaluate(sphere_columns(), {&coarse, 1}, 0, Coordinates::homogeneous).position)
                  .norm(),
              rounding(16));
  }
}

TEST(SplineSurface, CollapsedSidesHaveANormalWhereThereIsAPlane) {
  const SplineSurface bezier(bezier_knots<double>(2), bezier_knots<double>(2));
  // A disk's sector: one row in the centre, the next ones turn around it.
  const auto patch = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    Points points(9, 3);
    const Eigen::Vector3d apex(0.3, 0.1, 0.7);
    const Eigen::Vector3d ways[] = {a, b, c};
    for (Index j = 0; j < 3; ++j)
      for (Index i = 0; i < 3; ++i) points.row(3 * j + i) = (apex + j * ways[i]).transpose();
    return points;
  };
  const auto at = [&](const Points& points, double u, double v) {
    const Place s{0, u, v};
    return bezier.evaluate(points, {&s, 1}, 1);
  };
  // Transposed, or the other way round, the collapsed side is another one; the normal stays that of du x dv.
  const auto turned = [](const Points& points, bool transpose, bool reverse) {
    Points result(9, 3);
    for (Index j = 0; j < 3; ++j)
      for (Index i = 0; i < 3; ++i) {
        const Index row = reverse ? 2 - j : j;
        result.row(transpose ? row + 3 * i : i + 3 * row) = points.row(i + 3 * j);
      }
    return result;
  };
  const Points flat = patch({1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  for (const bool transpose : {false, true})
    for (const bool reverse : {false, true}) {
      const Points points = turned(flat, transpose, reverse);
      const double end = reverse ? 1 : 0, inside = reverse ? 0.75 : 0.25;
      for (const double along : {0.0, 0.4, 1.0}) {
        const LimitSamples pole = transpose ? at(points, end, along) : at(points, along, end);
        const LimitSamples near = transpose ? at(points, inside, 0.4) : at(points, 0.4, inside);
        EXPECT_LE((pole.normal - near.normal).norm(), rounding(16));
        EXPECT_EQ(pole.status[0], LimitStatus::regular);
        EXPECT_NEAR(std::abs(pole.normal(0, 2)), 1, rounding(4));
      }
    }
  // A cone's apex, a fold back and forth, a spike: no plane.
  for (const Points& points : {patch({1, 0, 1}, {1, 1, 0}, {0, 1, 1}), patch({1, 0, 0}, {0, 1, 0}, {1, 0, 0}),
                               patch({1, 0, 0}, {2, 0, 0}, {1, 0, 0})}) {
    const LimitSamples apex = at(points, 0.4, 0);
    EXPECT_EQ(apex.status[0], LimitStatus::undefined_normal);
    EXPECT_TRUE(apex.normal.isZero(0));
    EXPECT_LE((apex.position.row(0) - Eigen::RowVector3d(0.3, 0.1, 0.7)).norm(), rounding(2));
  }
  const LimitSamples point = at(Points::Ones(9, 3), 0.4, 0.5);
  EXPECT_EQ(point.status[0], LimitStatus::undefined_normal);
}

TEST(SplineSurface, SaysWhereThereIsAPoleOrNoPlace) {
  const SplineSurface surface(bezier_knots<double>(2), bezier_knots<double>(1));
  std::mt19937 random(23);
  Eigen::VectorXd weights(6);
  weights << 1, -1, 1, 1, 1, 1;  // (1 - 2u)^2 along v = 0
  const Points columns = homogeneous(random_points(random, 6, 3), weights);
  const Place samples[] = {{0, 0.5, 0}, {0, 0.5, 0.25}, {0, 1.5, 0},
                           {1, 0, 0},   {-1, 0, 0},     {0, std::numeric_limits<double>::quiet_NaN(), 0}};
  const LimitSamples at = surface.evaluate(columns, samples, 2, Coordinates::homogeneous);
  EXPECT_EQ(at.status[0], LimitStatus::pole);
  EXPECT_EQ(at.status[1], LimitStatus::regular);
  EXPECT_EQ(at.order[0], 0);
  EXPECT_EQ(at.order[1], 2);
  for (int i = 2; i < 6; ++i) EXPECT_EQ(at.status[i], LimitStatus::outside);
  for (const int i : {0, 2, 3, 4, 5}) {
    EXPECT_TRUE(at.position.row(i).isZero(0));
    EXPECT_FALSE(has_position(at.status[i]));
  }
}

TEST(SplineSurface, PlacesAndParametersAreTheSame) {
  const SplineSurface surface(Knots<double>::open(2, 5, {0, 0, 0, 1, 3, 4, 4, 4}), Knots<double>::closed(3, {0, 1, 2}));
  const Place s = surface.place({.u = 2, .v = 1.25});
  EXPECT_EQ(s.face, 1 + 3 * 1);
  EXPECT_EQ(s.u, 0.5);
  EXPECT_EQ(s.v, 0.25);
  const SplineSurface::Parameters back = surface.parameters({.face = 4, .u = 1, .v = 0});
  EXPECT_EQ(back.u, 3);
  EXPECT_EQ(back.v, 1);
  EXPECT_EQ(surface.place(back).face, 4);  // the side of the face comes with it
  EXPECT_EQ(surface.place(back).u, 1);
}

TEST(SplineSurface, RefusesWhatIsNotThere) {
  const SplineSurface surface(bezier_knots<double>(2), bezier_knots<double>(1));
  expect_error<InvalidParameter>([&] { surface.stencil({1, 0, 0}); }, {"face 1 does not exist", "1 squares"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 0, 1.5}); }, {"(0, 1.5)", "outside the square"});
  expect_error<InvalidParameter>([&] { surface.stencil({0, 0, 0}, 3); }, {"order 3"});
  expect_error<InvalidParameter>([&] { surface.evaluate(Points::Zero(6, 4), {}); }, {"6 x 4, not 6 x 3"});
  expect_error<InvalidParameter>([&] { surface.evaluate(Points::Zero(6, 3), {}, 0, Coordinates::homogeneous); },
                                 {"6 x 3, not 6 x 4"});
  expect_error<InvalidParameter>([&] { surface.place({.u = 0.5, .v = 2}); }, {"2", "outside the domain, 0 to 1"});
  std::vector<double> many(100001);
  for (size_t i = 0; i < many.size(); ++i) many[i] = double(i);
  const auto long_knots = Knots<double>::closed(1, many);
  expect_error<ResourceError>([&] { SplineSurface(long_knots, long_knots); }, {"100000 x 100000", "32-bit"});
}

TEST(SplineSurface, UniformClosedOnesAreLimitsOfCatmullClarkAndDooSabin) {
  std::mt19937 random(24);
  const Index n = 6, m = 5;
  const auto uniform = [](int degree, Index points) {
    std::vector<double> breaks;
    for (Index i = 0; i <= points; ++i) breaks.push_back(i);
    return Knots<double>::closed(degree, breaks);
  };
  const Points x = random_points(random, n * m, 3);
  Mesh mesh = torus(n, m);  // its vertex and its face (i, j) are number m i + j, u along i
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i) mesh.positions.row(m * i + j) = x.row(i + n * j);
  for (const int degree : {3, 2}) {
    const SplineSurface surface(uniform(degree, n), uniform(degree, m));
    const LimitMap limit(find_scheme(degree == 3 ? "catmull-clark" : "doo-sabin").value(), mesh);
    for (int k = 0; k < 60; ++k) {
      const Place s = {static_cast<Index>(random() % (n * m)), double(random() % 64) / 64, double(random() % 64) / 64};
      // Control point i has the parameter of its Greville abscissa: i - 1, and i - 1/2 for quadratics.
      const double shift = degree == 3 ? -1 : -0.5;
      const double u = s.face / m + s.u + shift + n, v = s.face % m + s.v + shift + m;
      const Place place = surface.place({.u = u - n * std::floor(u / n), .v = v - m * std::floor(v / m)});
      const LimitSamples a = surface.evaluate(x, {&place, 1}, 1), b = limit.evaluate(mesh.positions, {&s, 1}, 1);
      EXPECT_LE((a.position - b.position).norm(), reference);
      EXPECT_LE((a.du - b.du).norm() + (a.dv - b.dv).norm(), first_derivative * (1 + a.du.norm() + a.dv.norm()));
      EXPECT_LE((a.normal - b.normal).norm(), reference_angle);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing

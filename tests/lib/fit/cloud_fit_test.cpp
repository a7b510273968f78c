// SPDX-License-Identifier: Apache-2.0
// Surfaces through clouds: found again, always downhill, and not through noise.
#include "sublimit/fit/cloud_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Known {
  LimitMap surface;
  Points guess, truth;
  Cloud cloud;
};

Known known(const char* name, double amount, double noise = 0) {
  const Scheme<double> scheme = *find_scheme<double>(name);
  const Mesh mesh = takes_triangles(scheme) ? icosahedron() : torus(6, 5);
  Known k{LimitMap(scheme, mesh), mesh.positions, jittered(mesh, amount).positions, {}};
  k.cloud.points = k.surface.evaluate(k.truth, random_places(k.surface.addresses(), 600, 2)).position;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < k.cloud.points.size(); ++i) k.cloud.points.data()[i] += noise * normal(random);
  return k;
}

void expect_downhill(const CloudFit& fit) {
  for (size_t i = 1; i < fit.iterations.size(); ++i)
    EXPECT_LE(fit.iterations[i].energy, fit.iterations[i - 1].energy) << "iteration " << i;
}

TEST(CloudFit, FindsTheSurfaceThatItsPointsAreFrom) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin"}) {
    SCOPED_TRACE(name);
    const Known k = known(name, 0.05);
    const double size = diagonal(k.cloud.points);
    int told = 0;
    const CloudFit fit = fit_cloud(k.surface, k.cloud, k.guess, {.progress = [&](int i, const CloudIteration& it) {
                                     EXPECT_EQ(i, told++);
                                     EXPECT_LE(it.rms, it.largest);
                                   }});
    EXPECT_EQ(told, int(fit.iterations.size()));
    EXPECT_TRUE(fit.converged);
    EXPECT_GT(fit.iterations.front().rms, 1e-3 * size);
    EXPECT_LE(fit.iterations.back().largest, found_again * size);
    EXPECT_LE((fit.points - k.truth).rowwise().norm().maxCoeff(), found_control_points * size);
    expect_downhill(fit);
    EXPECT_EQ(fit.foot_points.distances.maxCoeff(), fit.iterations.back().largest);
  }
}

TEST(CloudFit, GoesDownhillPointToPoint) {
  const Known k = known("catmull-clark", 0.15);
  const CloudFit fit = fit_cloud(k.surface, k.cloud, k.guess, {.tangential = 1, .iterations = 12});
  ASSERT_EQ(fit.iterations.size(), 13u);
  EXPECT_FALSE(fit.converged);
  for (size_t i = 1; i < fit.iterations.size(); ++i) EXPECT_LT(fit.iterations[i].rms, fit.iterations[i - 1].rms);
  EXPECT_LT(fit.iterations.back().rms, fit.iterations.front().rms / 10);
}

TEST(CloudFit, GoesDownhillFromFarOffToo) {
  // Tangent planes alone would overshoot.
  const Known k = known("catmull-clark", 0.7);
  const CloudFit fit = fit_cloud(k.surface, k.cloud, k.guess, {.tangential = 1e-6, .iterations = 6});
  expect_downhill(fit);
  EXPECT_GT(fit.iterations.size(), 2u);
}

TEST(CloudFit, StretchesToTheBorderOfTheCloud) {
  const Mesh mesh = grid(4, 3);
  const LimitMap surface(*find_scheme<double>("catmull-clark"), mesh);
  Points truth = mesh.positions;
  truth.leftCols(2) *= 1.2;
  std::vector<Place> places = random_places(surface.addresses(), 300, 4);
  for (double s = 0; s <= 1; s += 0.125) {
    places.push_back({0, s, 0});
    places.push_back({11, s, 1});
  }
  const CloudFit fit =
      fit_cloud(surface, {surface.evaluate(truth, places).position}, mesh.positions, {.iterations = 8});
  expect_downhill(fit);
  EXPECT_LE(fit.iterations.back().rms, fit.iterations.front().rms / 50);
}

TEST(CloudFit, FairnessAndItsScheduleAndPinsHold) {
  Known k = known("catmull-clark", 0.1, 0.02);
  k.cloud.weights.assign(600, 2.0);
  k.cloud.weights[3] = 0;
  CloudFitOptions options{.fairness = {.thin_plate = 1e-4}, .schedule = {10, 5, 1}, .iterations = 20};
  options.pins.vertices = {4};
  options.pins.values = k.truth.row(4);
  const CloudFit fit = fit_cloud(k.surface, k.cloud, k.guess, options);
  EXPECT_EQ(fit.points.row(4), k.truth.row(4));
  EXPECT_EQ(fit.iterations[1].fairness, 10);
  EXPECT_EQ(fit.iterations[2].fairness, 5);
  EXPECT_EQ(fit.iterations.back().fairness, 1);
  EXPECT_GE(fit.iterations.size(), 4u);
  // The mean square of the noise is that of its part across the surface.
  constexpr double by_chance = 0.005;  // a few standard deviations of the mean of so many squares
  EXPECT_NEAR(fit.iterations.back().rms, 0.02, by_chance);
  // Energy is what it says.
  const SparseMatrix H = fairness_energy(k.surface, options.fairness);
  const double mean = (fit.foot_points.distances.squaredNorm() - std::pow(fit.foot_points.distances[3], 2)) / 599;
  EXPECT_NEAR(fit.iterations.back().energy, mean + (fit.points.transpose() * (H * fit.points)).trace(),
              other_route * fit.iterations.back().energy);
  // More of it, a fairer surface farther away.
  const auto stiffness = [&](const CloudFit& f) { return (f.points.transpose() * (H * f.points)).trace(); };
  options.schedule = {100};
  const CloudFit stiff = fit_cloud(k.surface, k.cloud, k.guess, options);
  expect_downhill(stiff);
  EXPECT_LT(stiffness(stiff), stiffness(fit));
  EXPECT_GT(stiff.iterations.back().rms, fit.iterations.back().rms);
}

TEST(CloudFit, LeavesAloneWhatNoPointSees) {
  Known k = known("loop", 0.02);
  std::vector<Place> places(40);
  for (size_t i = 0; i < places.size(); ++i) places[i] = {0, 0.1 + 0.01 * double(i), 0.3};
  k.cloud.points = k.surface.evaluate(k.truth, places).position;
  const CloudFit fit = fit_cloud(k.surface, k.cloud, k.guess);
  const LimitStencil seen = k.surface.stencil({0, 0.3, 0.3});
  int unseen = 0;
  for (Index v = 0; v < 12; ++v) {
    bool is_seen = false;
    for (const Index s : seen.vertices) is_seen |= s == v;
    if (is_seen) continue;
    ++unseen;
    EXPECT_LE((fit.points.row(v) - k.guess.row(v)).norm(), found_again) << "vertex " << v;
  }
  EXPECT_GT(unseen, 0);
}

TEST(Cloud, HasThePointsOfAMesh) {
  Mesh mesh = cube();
  const Cloud vertices = cloud_of_vertices(mesh);
  ASSERT_EQ(vertices.points.rows(), 8);
  double area = 0;
  for (const double w : vertices.weights) area += w;
  EXPECT_NEAR(area, 24, rounding(24, 24));
  mesh.positions.conservativeResize(9, Eigen::NoChange);
  mesh.positions.row(8).setZero();
  EXPECT_EQ(cloud_of_vertices(mesh).points.rows(), 8) << "vertices of no face are left out";
  // A face of half the size of the others has half as many points.
  mesh.positions.leftCols(1) *= 0.5;
  const Cloud faces = cloud_of_faces(mesh, 800, 3);
  ASSERT_EQ(faces.points.rows(), 800);
  int on_whole = 0;
  for (Index i = 0; i < 800; ++i) {
    const Eigen::Array3d p = faces.points.row(i).transpose().array() / Eigen::Array3d(0.5, 1, 1);
    EXPECT_NEAR(p.abs().maxCoeff(), 1, rounding(10));
    on_whole += std::abs(std::abs(p[0]) - 1) < rounding(10);
  }
  constexpr double by_chance = 2;  // samples are spread evenly over the area, so few of 400 change sides
  EXPECT_NEAR(on_whole, 400, by_chance) << "two whole faces, four halves";
  EXPECT_EQ(cloud_of_faces(mesh, 800, 3).points, faces.points);
}

TEST(CloudFit, SaysWhatIsWrong) {
  const Known k = known("catmull-clark", 0.1);
  const auto fails = [&](const auto& change, std::initializer_list<std::string_view> parts) {
    Cloud cloud{k.cloud.points.topRows(5)};
    Points guess = k.guess;
    CloudFitOptions options;
    change(cloud, guess, options);
    expect_error<InvalidParameter>([&] { fit_cloud(k.surface, cloud, guess, options); }, parts);
  };
  using C = Cloud;
  using O = CloudFitOptions;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  fails([](C& c, Points&, O&) { c.points.resize(0, 3); }, {"without points"});
  fails([&](C& c, Points&, O&) { c.points(2, 0) = nan; }, {"point 2", "finite"});
  fails([](C& c, Points&, O&) { c.weights = {1, 1}; }, {"2 weights", "5 points"});
  fails([](C& c, Points&, O&) { c.weights = {1, 1, -1, 1, 1}; }, {"point 2", "-1"});
  fails([](C& c, Points&, O&) { c.weights.assign(5, 0); }, {"weight > 0"});
  fails([](C&, Points&, O& o) { o.tangential = 0; }, {"> 0 and <= 1"});
  fails([&](C&, Points&, O& o) { o.schedule = {1, nan}; }, {"schedule", "nan"});
  fails([&](C&, Points&, O& o) { o.tolerance = nan; }, {"tolerance"});
  fails([](C&, Points&, O& o) { o.pins.vertices = {40}; }, {"control point 40"});
  fails([](C&, Points& x, O&) { x = Points::Zero(3, 3); }, {"3 x 3"});
  fails([](C&, Points& x, O&) { x = Points::Zero(30, 2); }, {"2 columns"});
  Mesh flat = cube();
  flat.positions.setZero();
  expect_error<InvalidMesh>([&] { cloud_of_faces(flat, 1); }, {"no area"});
  flat.positions(3, 0) = nan;
  expect_error<InvalidMesh>([&] { cloud_of_vertices(flat); }, {"vertex 3"});
}

}  // namespace
}  // namespace sublimit::testing

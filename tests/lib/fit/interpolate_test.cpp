// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/interpolate.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// What is promised, of the box and in radians.
constexpr double on_target = 1e-12, along_target = 1e-10;
/// Of values that texts print with four.
constexpr double four_digits = 5e-5;

std::vector<VertexTarget> at_vertices(const Mesh& mesh) {
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) targets.push_back({.vertex = v, .position = mesh.positions.row(v)});
  return targets;
}

/// The same with normals away from the middle of the mesh.
std::vector<VertexTarget> with_normals(const Mesh& mesh) {
  std::vector<VertexTarget> targets = at_vertices(mesh);
  const Eigen::RowVector3d middle = mesh.positions.colwise().mean();
  for (VertexTarget& target : targets) target.normal = 2 * (target.position - middle.transpose());
  return targets;
}

/// Points and normals of the limit of what was found, by the way that knows nothing of fitting: vertices of one side.
LimitPoints limits_of(const Scheme<double>& scheme, const Interpolation& found) {
  LimitCache cache(scheme);
  return limit_points(limit_matrices(found.level, cache), found.level.topology(), found.points);
}

void expect_through(const Scheme<double>& scheme, const Interpolation& found, const std::vector<VertexTarget>& targets,
                    double box) {
  EXPECT_TRUE(found.solved()) << why_unsolved(found.attempts.back());
  const LimitPoints limits = limits_of(scheme, found);
  for (const VertexTarget& target : targets) {
    EXPECT_LE((limits.position.row(target.vertex).transpose() - target.position).norm(), on_target * box);
    if (!target.normal) continue;
    const Eigen::Vector3d n = limits.normal.row(target.vertex), N = target.normal->normalized();
    EXPECT_LE(n.cross(N).norm(), along_target);
    EXPECT_GT(n.dot(N), 0);
  }
}

/// Catmull-Clark's limit masks on a regular grid are a product of (1, 4, 1)/6 both ways: the least eigenvalue is (4 -
/// 2)^2/36.
TEST(Interpolation, TorusGridIsSquareAndItsLeastSingularValueIsOneNinth) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const Mesh mesh = jittered(torus(12, 8));
  const auto targets = at_vertices(mesh);
  const Interpolation found = interpolate(scheme, mesh, targets);
  expect_through(scheme, found, targets, diagonal(mesh.positions));
  ASSERT_EQ(found.attempts.size(), 1u);
  EXPECT_EQ(found.attempts[0].refinements, 0);
  EXPECT_EQ(found.attempts[0].conditioning.rank, 96);
  EXPECT_NEAR(found.attempts[0].conditioning.smallest, 1.0 / 9, eigen());
}

TEST(Interpolation, SubdividedCubeIsSquare) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const Mesh mesh = quads_from_triangles(quads_from_triangles(cube()));
  const auto targets = at_vertices(jittered(mesh));
  const Interpolation found = interpolate(scheme, mesh, targets);
  expect_through(scheme, found, targets, diagonal(mesh.positions));
  EXPECT_EQ(found.attempts.back().refinements, 0);
}

/// The limit of a corner sees its neighbours with weights that cancel for alternating signs: eigenvalue 0.
TEST(Interpolation, CubeIsSingularAndSolvedWithMoreControlPoints) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const auto targets = at_vertices(jittered(cube()));
  const Interpolation without = interpolate(scheme, cube(), targets, {.most_refinements = 0});
  ASSERT_EQ(without.attempts.size(), 1u);
  EXPECT_FALSE(without.solved());
  EXPECT_EQ(without.attempts[0].conditioning.rank, 7);
  EXPECT_EQ(without.attempts[0].undetermined.size(), 8u);
  EXPECT_EQ(without.attempts[0].contradictory.size(), 8u);
  EXPECT_NE(why_unsolved(without.attempts[0]).find("vertices 0, 1, 2"), std::string::npos);

  const Interpolation found = interpolate(scheme, cube(), targets);
  ASSERT_EQ(found.attempts.size(), 2u);
  EXPECT_EQ(found.attempts[1].refinements, 1);
  EXPECT_EQ(found.level.topology().num_vertices(), 26);
  expect_through(scheme, found, targets, diagonal(cube().positions));
}

/// Its own corners are in the range of the singular system: coordinates have the eigenvalue 1/2.
TEST(Interpolation, CubeThroughItsOwnCornersIsTwiceAsLarge) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const Interpolation found = interpolate(scheme, cube(), at_vertices(cube()), {.most_refinements = 0});
  ASSERT_TRUE(found.solved());
  EXPECT_LE((found.points - 2 * cube().positions).cwiseAbs().maxCoeff(), on_target);
}

/// By hand: all vertices of a platonic solid have valence n, with e the weight of a neighbour the
/// eigenvalues are those of its graph.
TEST(Interpolation, LoopSolidsHaveTheSmallestSingularValuesOfTheirGraphs) {
  const auto scheme = *find_scheme<double>("loop");
  for (const auto& [mesh, smallest] :
       {std::pair(tetrahedron(), 0.2), std::pair(octahedron(), 0.1545), std::pair(icosahedron(), 0.2350)}) {
    const auto targets = at_vertices(jittered(mesh));
    const Interpolation found = interpolate(scheme, mesh, targets);
    expect_through(scheme, found, targets, diagonal(mesh.positions));
    EXPECT_NEAR(found.attempts[0].conditioning.smallest, smallest, four_digits);
  }
}

TEST(Interpolation, PointsAndNormalsNeedOneRefinement) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  for (const Mesh& mesh : {cube(), pole(5), prism(7), quads_from_triangles(icosahedron())}) {
    const auto targets = with_normals(jittered(mesh));
    const Interpolation found = interpolate(scheme, mesh, targets);
    expect_through(scheme, found, targets, diagonal(mesh.positions));
    EXPECT_EQ(found.attempts.back().refinements, 1);
  }
}

/// 17 conditions on 24 coordinates.
TEST(Interpolation, ANormalAloneNeedsNoRefinement) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  std::vector<VertexTarget> targets = at_vertices(jittered(cube()));
  targets.resize(5);
  targets[2].normal = targets[2].position;
  const Interpolation found = interpolate(scheme, cube(), targets);
  EXPECT_EQ(found.attempts.back().refinements, 0);
  expect_through(scheme, found, targets, diagonal(cube().positions));
}

TEST(Interpolation, TooManyRefinementsAreRefusedBeforeTheyAreMade) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  EXPECT_THROW(interpolate(scheme, cube(), at_vertices(cube()), {.least_refinements = 40, .most_refinements = 40}),
               ResourceError);
}

TEST(Interpolation, VerticesInHolesAloneHaveNoLimit) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  Mesh mesh = grid(4, 4);
  mesh.boundary = Boundary::none;  // faces at the border are holes
  expect_error<InvalidParameter>([&] { interpolate(scheme, mesh, {{.vertex = 0}}); }, {"vertex 0", "in holes alone"});
  EXPECT_TRUE(interpolate(scheme, mesh, {{.vertex = 12, .position = mesh.positions.row(12)}}).solved());
}

TEST(Interpolation, FairnessChoosesAmongThem) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const auto targets = with_normals(jittered(cube()));
  const Fairness fairness{.thin_plate = 1, .membrane = 0.1};
  const Interpolation near = interpolate(scheme, cube(), targets, {.least_refinements = 1, .most_refinements = 1});
  const Interpolation fair =
      interpolate(scheme, cube(), targets, {.least_refinements = 1, .most_refinements = 1, .fairness = fairness});
  expect_through(scheme, fair, targets, diagonal(cube().positions));
  const SparseMatrix H = fairness_energy(LimitMap(scheme, fair.level), fairness);
  const auto product = [&](const Points& a, const Points& b) { return (a.transpose() * (H * b)).trace(); };
  const double energy = product(fair.points, fair.points);
  EXPECT_LT(energy, 0.95 * product(near.points, near.points));
  // Both meet the conditions, so from the fairest the way to the other one goes level at first.
  EXPECT_NEAR(product(fair.points, near.points - fair.points), 0, on_target * energy);
}

TEST(Interpolation, InterpolatorySchemesMoveNoVertex) {
  const auto scheme = *find_scheme<double>("butterfly");
  const Mesh mesh = icosahedron();
  const auto targets = with_normals(mesh);
  const Interpolation found = interpolate(scheme, mesh, targets);
  expect_through(scheme, found, targets, diagonal(mesh.positions));
  EXPECT_LE((found.points.topRows(12) - mesh.positions).cwiseAbs().maxCoeff(), rounding(8, 2));
}

TEST(Interpolation, BadTargetsAreRefusedByName) {
  const auto scheme = *find_scheme<double>("catmull-clark");
  const auto refused = [&](VertexTarget target, std::initializer_list<std::string_view> parts) {
    std::vector<VertexTarget> targets = at_vertices(cube());
    targets.pop_back();
    targets.push_back(target);
    expect_error<InvalidParameter>([&] { interpolate(scheme, cube(), targets); }, parts);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused({.vertex = 8}, {"target 7", "vertex 8 does not exist", "0 to 7"});
  refused({.vertex = 3}, {"target 7", "vertex 3 has a target already"});
  refused({.vertex = 7, .position = {0, nan, 0}}, {"target 7", "vertex 7", "position is not finite"});
  refused({.vertex = 7, .normal = Eigen::Vector3d(0, 0, 0)}, {"vertex 7", "length 0"});
  refused({.vertex = 7, .normal = Eigen::Vector3d(0, nan, 0)}, {"vertex 7", "normal is not finite"});
  expect_error<InvalidParameter>(
      [&] { interpolate(scheme, cube(), {}, {.least_refinements = 2, .most_refinements = 1}); }, {"from 2 to 1"});
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Grids and boxes of limit surfaces.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "meshes/hard_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(LimitGrid, HasRowsInOrder) {
  const LimitMap squares(*find_scheme("catmull-clark"), prism(5));  // 5 quads and two pentagons
  EXPECT_EQ(squares.addresses().size(), 15);
  const std::vector<Place> grid = squares.grid(3);
  ASSERT_EQ(grid.size(), 15u * 9);
  EXPECT_EQ(grid[10].face, 1);
  EXPECT_EQ(grid[10].u, 0.5);
  EXPECT_EQ(grid[10].v, 0);
  EXPECT_EQ(LimitMap(*find_scheme("loop"), octahedron()).grid(4).size(), 8u * 10);
  EXPECT_THROW(squares.grid(1), InvalidParameter);
}

TEST(LimitGrid, SharedPointsHaveTheSameBits) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin", "butterfly"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme(name);
    const bool triangles = scheme.face_size() == 3;
    const Mesh mesh = triangles ? hard_triangles(3, {.open = true}) : hard_polygons(3, {.open = true});
    const LimitMap surface(scheme, mesh);
    constexpr int N = 5;
    const std::vector<Place> places = surface.grid(N);
    const LimitSamples grid = surface.evaluate_grid(mesh.positions, N, 1),
                       alone = surface.evaluate(mesh.positions, places, 1);
    ASSERT_EQ(grid.position.rows(), Index(places.size()));
    const double size = mesh.positions.cwiseAbs().maxCoeff();
    EXPECT_LT((grid.position - alone.position).cwiseAbs().maxCoeff(),
              rounding(40, size));  // one side's for the other's
    EXPECT_EQ(grid.du, alone.du);
    EXPECT_EQ(grid.normal, alone.normal);
    // Places that are the same to rounding are the same to the bit.
    std::map<std::array<std::int64_t, 3>, Eigen::RowVector3d> seen;
    Index shared = 0;
    for (Index i = 0; i < grid.position.rows(); ++i) {
      const Eigen::RowVector3d p = grid.position.row(i);
      std::array<std::int64_t, 3> key;
      for (int k = 0; k < 3; ++k) key[k] = std::llround(p[k] / size * 1e9);
      const auto [at, is_new] = seen.try_emplace(key, p);
      shared += !is_new;
      if (!is_new) {
        EXPECT_EQ(at->second, p) << places[i].face << " " << places[i].u << " " << places[i].v;
      }
    }
    EXPECT_GT(shared, Index(places.size()) / 5);
  }
}

TEST(LimitGrid, SidesOfNonmanifoldEdgesAreApartUnderDualSchemes) {
  Mesh mesh = grid(2, 2);  // a third face at the edge between two of them
  const auto v = mesh.positions.rows();
  mesh.positions.conservativeResize(v + 2, Eigen::NoChange);
  mesh.positions.bottomRows(2) << 0, 1, 2, 1, 1, 2;
  const Index a = mesh.face_vertices[1], b = mesh.face_vertices[2];
  mesh.face_sizes.push_back(4);
  mesh.face_vertices.insert(mesh.face_vertices.end(), {b, a, static_cast<Index>(v), static_cast<Index>(v + 1)});
  for (const char* name : {"catmull-clark", "doo-sabin", "mid-edge"}) {
    SCOPED_TRACE(name);
    const LimitMap surface(*find_scheme(name), mesh);
    const LimitSamples grid = surface.evaluate_grid(mesh.positions, 4),
                       alone = surface.evaluate(mesh.positions, surface.grid(4));
    EXPECT_LT((grid.position - alone.position).cwiseAbs().maxCoeff(), rounding(40, 2));
  }
}

TEST(LimitBoxes, HoldTheirPartOfTheLimit) {
  std::mt19937 numbers(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Scheme<double>& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name);
    const bool triangles = scheme.face_size() == 3;
    const Mesh mesh = jittered(triangles ? triangle_grid(4, 3) : grid(4, 3), 0.3);
    const LimitMap surface(scheme, mesh);
    const std::vector<Eigen::AlignedBox3d> boxes = surface.bounding_boxes(mesh.positions);
    ASSERT_EQ(Index(boxes.size()), surface.addresses().size());
    std::vector<Place> samples;
    for (Index f = 0; f < surface.addresses().size(); ++f)
      for (int i = 0; i < 40; ++i) {
        double u = uniform(numbers), v = uniform(numbers);
        if (triangles && u + v > 1) u = 1 - u, v = 1 - v;
        samples.push_back({f, u, v});
      }
    const LimitSamples found = surface.evaluate(mesh.positions, samples);
    const double whole = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
    for (size_t i = 0; i < samples.size(); ++i)
      EXPECT_TRUE(boxes[samples[i].face].contains(Eigen::Vector3d(found.position.row(Index(i)))))
          << samples[i].face << " (" << samples[i].u << ", " << samples[i].v << ")";
    for (const Eigen::AlignedBox3d& box : boxes) EXPECT_LT(box.diagonal().norm(), 2 * whole);  // not all of space
  }
  EXPECT_THROW(LimitMap(*find_scheme("loop"), octahedron()).bounding_boxes(Points::Zero(3, 3)), InvalidParameter);
}

}  // namespace
}  // namespace sublimit::testing

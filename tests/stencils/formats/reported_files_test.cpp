// SPDX-License-Identifier: Apache-2.0
// Files as people reported them, if they are beside the checkout: the same cube in forms that readers refused. What is
// the matter with each, the tests of its format say with texts of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {
namespace {

/// Expects the surface of [-1, 1]^3: corners once each, faces in planes, all edges twice and in both directions.
void expect_cube(const Mesh& mesh, Index corners_of_face) {
  ASSERT_EQ(mesh.num_vertices(), 8);
  for (Index v = 0; v < 8; ++v) {
    EXPECT_TRUE((mesh.positions.row(v).array().abs() == 1).all());
    for (Index w = 0; w < v; ++w) EXPECT_NE(mesh.positions.row(v), mesh.positions.row(w));
  }
  double volume = 0;
  std::set<std::pair<Index, Index>> edges;
  std::size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    EXPECT_EQ(size, corners_of_face);
    const auto corner = [&](Index i) { return mesh.face_vertices[first + std::size_t(i % size)]; };
    const auto at = [&](Index i) { return Eigen::Vector3d(mesh.positions.row(corner(i))); };
    for (Index i = 0; i < size; ++i) EXPECT_TRUE(edges.emplace(corner(i), corner(i + 1)).second);
    for (Index i = 1; i + 1 < size; ++i) volume += at(0).dot(at(i).cross(at(i + 1))) / 6;
    first += std::size_t(size);
  }
  for (const auto& [tail, head] : edges) EXPECT_TRUE(edges.contains({head, tail}));
  EXPECT_EQ(std::round(volume), 8);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(ReportedFiles, AreCubes) {
  const auto folder = std::filesystem::path(SUBLIMIT_SHARED_MESHES).parent_path() / "reports";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "NO REPORTED FILES at " << folder;
  expect_cube(read_mesh(folder / "off-glued.off"), 4);
  expect_cube(read_mesh(folder / "off-face-on-several-lines.off"), 4);
  expect_cube(read_mesh(folder / "ply-tristrips.ply"), 3);
  expect_cube(read_mesh(folder / "ply-mixed-eol.ply"), 4);
  expect_cube(read_mesh(folder / "obj-continuation-space.obj"), 4);
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Refinement without matrices: faces, tags and points that levels and their matrices give, for every scheme.
#include "sublimit/scheme/refined_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>
#include <optional>

#include "meshes/meshes.h"
#include "meshes/point_intervals.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// What matrices make, or nothing where the scheme cannot take the mesh.
std::optional<Mesh> by_matrices(const Scheme<double>& scheme, const Mesh& mesh, int levels,
                                const SubdivisionOptions& options) {
  try {
    const std::vector<Level> all = refine(scheme, mesh, levels, options);
    Points points = mesh.positions;
    for (size_t k = 1; k < all.size(); ++k) points = apply(all[k].S, points);
    return level_mesh(all.back(), points, mesh, options);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Sharpness by the ends of the edges, however these are ordered.
std::map<std::pair<Index, Index>, float> creases(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, float> sharpness;
  for (const Mesh::Crease& c : mesh.creases) sharpness[std::minmax({c.tail, c.head})] = c.sharpness;
  return sharpness;
}
std::map<Index, float> corners(const Mesh& mesh) {
  std::map<Index, float> sharpness;
  for (const Mesh::Corner& c : mesh.corners) sharpness[c.vertex] = c.sharpness;
  return sharpness;
}

void expect_same_faces_and_tags(const Mesh& own, const Mesh& other) {
  EXPECT_EQ(own.face_sizes, other.face_sizes);
  EXPECT_EQ(own.face_vertices, other.face_vertices);
  EXPECT_EQ(creases(own), creases(other));
  EXPECT_EQ(corners(own), corners(other));
  EXPECT_EQ(own.holes, other.holes);
  EXPECT_EQ(own.boundary, other.boundary);
  EXPECT_EQ(own.creasing, other.creasing);
  EXPECT_EQ(own.triangles, other.triangles);
  EXPECT_EQ(own.knot_intervals.size(), other.knot_intervals.size());
}

std::vector<Mesh> meshes_of_all_kinds() {
  Mesh creased = cube();
  creased.creases = {{0, 1, 2.5f}, {1, 3, 10.f}, {3, 2, 1.f}};
  creased.corners = {{5, 1.5f}};
  Mesh chaikin = creased;
  chaikin.creasing = Creasing::chaikin;
  Mesh holed = grid(4, 3);
  holed.holes = {5};
  Mesh no_border = jittered(triangle_grid(4, 4));
  no_border.boundary = Boundary::none;
  const Mesh book =
      jittered(make_mesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  Mesh box = cube();
  box.knot_intervals = {{0, 1, 1}, {0, 2, 2.5}, {0, 4, 4}};
  return {jittered(cube()),
          jittered(octahedron()),
          jittered(torus(4, 5)),
          jittered(triangle_torus(4, 4)),
          jittered(prism(5)),
          jittered(open_fan(5, 3)),
          triangle_grid(3, 2),
          creased,
          chaikin,
          holed,
          no_border,
          mobius_strip(5),
          book,
          box,
          with_point_intervals(octahedron(), 3)};
}

TEST(RefinedMesh, IsThatOfTheMatricesForEveryScheme) {
  const std::vector<Mesh> meshes = meshes_of_all_kinds();
  int compared = 0, refused = 0;
  for (const Scheme<double>& scheme : all_schemes())
    for (size_t i = 0; i < meshes.size(); ++i)
      for (const int levels : {0, 1, 2}) {
        SCOPED_TRACE(scheme.name + ", mesh " + std::to_string(i) + ", level " + std::to_string(levels));
        SubdivisionOptions options;
        if (levels == 1) options.boundary = Boundary::edge_only;
        const std::optional<Mesh> expected = by_matrices(scheme, meshes[i], levels, options);
        if (!expected) {
          EXPECT_THROW(refined_mesh(scheme, meshes[i], levels, options), Error);
          EXPECT_THROW(Refiner(scheme, meshes[i], levels, options), Error);
          ++refused;
          continue;
        }
        const Mesh own = refined_mesh(scheme, meshes[i], levels, options);
        expect_same_faces_and_tags(own, *expected);
        ASSERT_EQ(own.positions.rows(), expected->positions.rows());
        // Rows are summed in another order than that of columns, and steps one after the other.
        EXPECT_LE((own.positions - expected->positions).cwiseAbs().maxCoeff(), rounding(64));
        const Refiner again(scheme, meshes[i], levels, options);
        expect_same_faces_and_tags(again.mesh(), own);
        EXPECT_EQ(again.num_points(), own.num_vertices());
        EXPECT_EQ((again.points(meshes[i].positions) - own.positions).norm(), 0);
        ++compared;
      }
  EXPECT_GT(compared, 300);
  EXPECT_GT(refused, 0);
}

TEST(RefinedMesh, GoesOnWhereItStopped) {
  for (const char* name : {"catmull-clark", "loop"}) {
    const Scheme<double> scheme = *find_scheme(name);
    Mesh mesh = name == std::string("loop") ? jittered(octahedron()) : jittered(cube());
    mesh.creases = {{0, 2, 2.5f}, {2, 1, 10.f}};
    mesh.corners = {{1, 1.5f}};
    if (name != std::string("loop")) mesh.creases = {{0, 1, 2.5f}, {1, 3, 10.f}};
    const Mesh once = refined_mesh(scheme, mesh, 3);
    const Mesh twice = refined_mesh(scheme, refined_mesh(scheme, mesh, 1), 2);
    expect_same_faces_and_tags(twice, once);
    EXPECT_LE((twice.positions - once.positions).cwiseAbs().maxCoeff(), rounding(64)) << name;
  }
}

TEST(RefinedMesh, DoesNotDependOnThreadsAndRefinersTakeAnyColumns) {
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  const Mesh mesh = jittered(torus(30, 20));
  const Points many = refined_mesh(scheme, mesh, 2).positions;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ((refined_mesh(scheme, mesh, 2).positions - many).norm(), 0);
  }
  Points columns(mesh.num_vertices(), 5);
  columns << mesh.positions, mesh.positions.leftCols(2);
  const Refiner refiner(scheme, mesh, 2);
  EXPECT_EQ(refiner.num_control_points(), mesh.num_vertices());
  const Points five = refiner.points(columns);
  EXPECT_EQ((five.leftCols(3) - many).norm(), 0);
  EXPECT_EQ((five.rightCols(2) - many.leftCols(2)).norm(), 0);
}

TEST(RefinedMesh, SaysWhatIsWrong) {
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  expect_error<InvalidParameter>([&] { refined_mesh(scheme, cube(), -1); }, {"levels is -1"});
  expect_error<InvalidParameter>([&] { Refiner(scheme, cube(), 1).points(Points::Zero(7, 3)); },
                                 {"8 vertices", "7 points"});
  expect_error<ResourceError>([&] { refined_mesh(scheme, cube(), 30); }, {"30 levels", "32-bit"});
  std::vector<int> told;
  refined_mesh(scheme, cube(), 3, {}, [&](int level) { told.push_back(level); });
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace sublimit::testing

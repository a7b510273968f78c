// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/bezier_cells.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/nets/net_derivatives.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::other_route;

struct Job {
  const char* scheme;
  Mesh mesh;
  int degree;  ///< of exact cells
};

std::vector<Job> jobs() {
  Mesh creased = testing::jittered(testing::cube());
  testing::add_crease(creased, {0, 1, 3}, 1.5);
  return {{"catmull-clark", testing::jittered(testing::torus(7, 5)), 3},
          {"catmull-clark", testing::jittered(testing::prism(5)), 3},
          {"catmull-clark", creased, 3},
          {"bilinear", testing::jittered(testing::cube()), 1},
          {"loop", testing::jittered(testing::icosahedron()), 4},
          {"doo-sabin", testing::jittered(testing::prism(5)), 2},
          {"mid-edge", testing::jittered(testing::torus(7, 5)), 4}};
}

/// De Casteljau's value at a place of the cell.
Eigen::RowVector3d value(const BezierCell& cell, double u, double v) {
  return NetDerivatives(PolynomialBasis(cell.degree, cell.triangle), cell.net, 1).at(u, v).x.head<3>();
}

TEST(BezierCells, AreTheLimitInside) {
  for (const Job& job : jobs()) {
    SCOPED_TRACE(job.scheme);
    const LimitMap surface(find_scheme(job.scheme).value(), job.mesh);
    const double size = testing::diagonal(job.mesh.positions), chord = 1e-3 * size;
    const BezierCells made = bezier_cells(surface, job.mesh.positions, chord);
    EXPECT_LE(made.bound, chord);
    EXPECT_GT(made.exact, 0);
    std::vector<Place> at;
    std::vector<Eigen::RowVector3d> own;
    std::vector<bool> exact;
    for (const BezierCell& cell : made.cells) {
      if (cell.exact) {
        EXPECT_EQ(cell.degree, job.degree);
      }
      for (const auto& [u, v] : {std::pair{0.25, 0.125}, std::pair{0.5, 0.25}, std::pair{0.125, 0.75}}) {
        const auto [s, t] = at_place(cell.corners, cell.triangle, u, v);
        at.push_back({cell.address, s, t});
        own.push_back(value(cell, u, v));
        exact.push_back(cell.exact);
      }
    }
    const Points limit = surface.evaluate(job.mesh.positions, at).position;
    for (size_t i = 0; i < at.size(); ++i)
      EXPECT_LE((limit.row(Index(i)) - own[i]).norm(), exact[i] ? other_route * size : made.bound);
  }
}

TEST(BezierCells, CoverEveryFaceOnce) {
  for (const Job& job : jobs()) {
    SCOPED_TRACE(job.scheme);
    const LimitMap surface(find_scheme(job.scheme).value(), job.mesh);
    std::vector<double> covered(size_t(surface.faces().size));
    for (const BezierCell& cell : bezier_cells(surface, job.mesh.positions, 1e-2).cells) {
      double twice = 0;
      const size_t n = cell.triangle ? 3 : 4;
      for (size_t k = 0; k < n; ++k) {
        const CellCorner &a = cell.corners[k], &b = cell.corners[(k + 1) % n];
        twice += (double(a.i) * b.j - double(a.j) * b.i) / (double(cell_steps) * cell_steps);
      }
      EXPECT_GT(twice, 0);
      covered[size_t(cell.address)] += twice / 2;
    }
    for (const double area : covered) EXPECT_EQ(area, surface.faces().triangles ? 0.5 : 1);
  }
}

TEST(BezierCells, AreOneAFaceWhereAllIsRegular) {
  const Mesh torus = testing::torus(8, 6);
  const LimitMap surface(find_scheme("catmull-clark").value(), torus);
  const BezierCells made = bezier_cells(surface, torus.positions, 1e-9);
  EXPECT_EQ(made.cells.size(), 48u);
  EXPECT_EQ(made.exact, 48);
  EXPECT_EQ(made.bound, 0);
}

TEST(BezierCells, RefuseInClearWords) {
  const Mesh cube = testing::cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), cube);
  EXPECT_THROW(bezier_cells(surface, cube.positions, 0), InvalidParameter);
  EXPECT_THROW(bezier_cells(surface, cube.positions, 1e-6, 100), ResourceError);
  const Mesh triangles = testing::icosahedron();
  const LimitMap butterfly(find_scheme("modified-butterfly").value(), triangles);
  EXPECT_THROW(bezier_cells(butterfly, triangles.positions, 0.1), UnsupportedTopology);
}

}  // namespace
}  // namespace sublimit

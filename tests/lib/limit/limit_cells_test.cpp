// SPDX-License-Identifier: Apache-2.0
// Cells hold the surface.
#include "sublimit/limit/limit_cells.h"

#include <gtest/gtest.h>

#include "support/places.h"
#include "support/tested_schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(LimitCells, HoldAllOfTheSurface) {
  for (const char* name : {"bilinear", "catmull-clark", "loop", "doo-sabin", "mid-edge", "butterfly"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    const bool quick = name != std::string("mid-edge") && name != std::string("butterfly");
    const ControlMesh mesh = quick ? hard_meshes(scheme, 3)[1] : takes_triangles(scheme) ? octahedron() : grid(3, 2);
    const LimitSurface surface(scheme, mesh);
    const double size = diagonal(mesh.positions);
    const std::vector<LimitCell> cells = limit_cells(surface, mesh.positions);
    const std::vector<Sample> places = random_places(surface.addresses(), quick ? 1000 : 60, 4);
    const LimitSamples samples = surface.evaluate(mesh.positions, places);
    for (size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d x = samples.position.row(Eigen::Index(i));
      bool held = false;
      for (const LimitCell& cell : cells) held |= cell.start.face == places[i].face && cell.squared_distance(x) == 0;
      EXPECT_TRUE(held) << "face " << places[i].face << " (" << places[i].u << ", " << places[i].v << ")";
    }
    // They start where they are, and are small.
    std::vector<Sample> starts;
    for (const LimitCell& cell : cells) starts.push_back(cell.start);
    const LimitSamples begin = surface.evaluate(mesh.positions, starts);
    for (size_t i = 0; i < cells.size(); i += quick ? 1 : 20) {
      const Eigen::Vector3d x = begin.position.row(Eigen::Index(i));
      const double width = cells[i].own_box.sizes().norm();
      EXPECT_LE(std::sqrt(cells[i].squared_distance(x)), 2 * width) << "cell " << i;
      EXPECT_LE(width, size / 2);
      EXPECT_LE((cells[i].frame * cells[i].frame.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding(9));
    }
  }
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Cells hold the surface.
#include "sublimit/nets/limit_cells.h"

#include <gtest/gtest.h>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(LimitCells, HoldAllOfTheSurface) {
  for (const char* name : {"bilinear", "catmull-clark", "loop", "doo-sabin", "mid-edge", "butterfly"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    const bool quick = name != std::string("mid-edge") && name != std::string("butterfly");
    const Mesh mesh = quick ? hard_meshes(scheme, 3)[1] : takes_triangles(scheme) ? octahedron() : grid(3, 2);
    const LimitMap surface(scheme, mesh);
    const double size = diagonal(mesh.positions);
    const std::vector<LimitCell> cells = limit_cells(surface, mesh.positions);
    const std::vector<Place> places = random_places(surface.addresses(), quick ? 1000 : 60, 4);
    const LimitSamples samples = surface.evaluate(mesh.positions, places);
    for (size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d x = samples.position.row(Eigen::Index(i));
      // By a box, and as near to the start as it says; a search needs a little more.
      bool held = false;
      for (const LimitCell& cell : cells)
        held |= cell.start.face == places[i].face && cell.squared_distance(x) == 0 &&
                std::max(std::abs(cell.start.u - places[i].u), std::abs(cell.start.v - places[i].v)) <= cell.radius;
      EXPECT_TRUE(held) << "face " << places[i].face << " (" << places[i].u << ", " << places[i].v << ")";
    }
    for (const LimitCell& cell : cells) {
      EXPECT_LE(cell.own_box.sizes().norm(), size / 2);
      EXPECT_LE((cell.frame * cell.frame.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding(9));
    }
  }
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Where something is proved, bounded or measured, points that are no numbers are refused by name: a bound of NaN
// compares as none at all.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/cad/limit_quads.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/nets/limit_cells.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/detail/winding.h"
#include "sublimit/search/intersect.h"
#include "sublimit/surface/limit_map.h"
#include "sublimit/tessellation/detail/bezier_cells.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

class ControlPoints : public ::testing::TestWithParam<const char*> {
 protected:
  const Mesh mesh_ = GetParam() == std::string("loop") ? octahedron() : cube();
  const LimitMap surface_{*find_scheme(GetParam()), mesh_};

  Points with(double x) const {
    Points points = mesh_.positions;
    points(3, 1) = x;
    return points;
  }
};

TEST_P(ControlPoints, AreFiniteWhereSomethingIsMeasured) {
  for (const double x : {nan, infinity, -infinity}) {
    const Points points = with(x);
    expect_error<InvalidMesh>([&] { limit_integrals(surface_, points); }, {"control point 3", "not finite"});
    expect_error<InvalidMesh>([&] { surface_.bounding_boxes(points); }, {"control point 3", "not finite"});
    expect_error<InvalidMesh>([&] { limit_cells(surface_, points); }, {"control point 3", "not finite"});
  }
}

TEST_P(ControlPoints, HaveSquaresWhereDistancesAreProved) {
  const Points query = Points::Zero(1, 3);
  const std::vector<Ray> rays{{.origin = {0, 0, 5}, .direction = {0, 0, -1}}};
  for (const double x : {nan, infinity, 1e308, -1e200}) {
    const Points points = with(x);
    const auto refused = [&](const auto& action) { expect_error<InvalidMesh>(action, {"control point 3 is ("}); };
    refused([&] { tessellate(surface_, points, {.chord = 0.1}); });
    refused([&] { bezier_cells(surface_, points, 0.1); });
    refused([&] { closest(surface_, points, query); });
    refused([&] { intersect(surface_, points, rays); });
    refused([&] { winding_numbers(PartedLimit(surface_, points), query); });
    refused([&] { limit_quads(surface_, points, {.tolerance = 0.1, .progress = {}}); });
  }
}

TEST_P(ControlPoints, MayBeLargeAndSmall) {
  for (const double scale : {1e60, 1e-60}) EXPECT_GT(limit_integrals(surface_, scale * mesh_.positions).area, 0);
  expect_error<InvalidMesh>([&] { limit_integrals(surface_, 1e140 * mesh_.positions); },  // a volume of 1e420
                            {"control point 0", "volume", "larger than numbers"});
  for (const double scale : {1e140, 1e-140}) {
    const Points points = scale * mesh_.positions;
    const ClosestPoints found = closest(surface_, points, Points::Zero(1, 3));
    ASSERT_EQ(found.distances.size(), 1);
    EXPECT_TRUE(std::isfinite(found.distances[0]));
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ControlPoints, ::testing::Values("catmull-clark", "doo-sabin", "loop"),
                         [](const auto& named) {
                           std::string name = named.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Queries, AreFinite) {
  const Mesh mesh = cube();
  const LimitMap surface(*find_scheme("catmull-clark"), mesh);
  Points queries = Points::Zero(3, 3);
  for (const double x : {nan, infinity, 1e200}) {
    queries(2, 0) = x;
    expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, queries); }, {"query point 2"});
    expect_error<InvalidParameter>([&] { winding_numbers(PartedLimit(surface, mesh.positions), queries); },
                                   {"point to look from 2"});
  }
}

}  // namespace
}  // namespace sublimit::testing

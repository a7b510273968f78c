// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/rated_tessellation.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

struct Shape {
  const char* scheme;
  Mesh mesh;
};

std::vector<Shape> closed_shapes() {
  return {{"catmull-clark", testing::jittered(testing::cube())},
          {"catmull-clark", testing::jittered(testing::prism(5))},
          {"catmull-clark", testing::jittered(testing::tetrahedron())},
          {"kobbelt", testing::jittered(testing::torus(7, 5))},
          {"loop", testing::jittered(testing::icosahedron())},
          {"modified-butterfly", testing::jittered(testing::icosahedron())}};
}

/// Area in parameters; all triangles go round counter-clockwise.
double covered(const Tessellation& t) {
  double area = 0;
  for (const Tessellation::Triangle& triangle : t.triangles) {
    const auto& [a, b, c] = triangle.uv;
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  return area;
}

TEST(RatedTessellation, IsClosedForAnyRates) {
  std::mt19937 random(3);
  for (const Shape& shape : closed_shapes()) {
    const LimitMap surface(find_scheme(shape.scheme).value(), shape.mesh);
    const Topology& t = surface.level().topology();
    for (int round = 0; round < 20; ++round) {
      SCOPED_TRACE(std::string(shape.scheme) + " " + std::to_string(round));
      std::vector<Index> rates;
      for (Index e = 0; e < t.num_edges(); ++e) rates.push_back(1 + static_cast<Index>(random() % 7));
      const Tessellation made = tessellate_by_rates(surface, shape.mesh.positions, rates);
      std::map<std::pair<Index, Index>, int> directed;
      for (const Tessellation::Triangle& triangle : made.triangles)
        for (size_t k = 0; k < 3; ++k) ++directed[{triangle.vertices[k], triangle.vertices[(k + 1) % 3]}];
      for (const auto& [edge, times] : directed) {
        EXPECT_EQ(times, 1);
        EXPECT_TRUE(directed.contains({edge.second, edge.first}));
      }
      EXPECT_EQ(Index(made.places.size()) - Index(directed.size()) / 2 + Index(made.triangles.size()),
                t.num_vertices() - t.num_edges() + t.num_faces());
      EXPECT_NEAR(covered(made), surface.faces().size * (surface.faces().triangles ? 0.5 : 1.0),
                  testing::rounding(double(made.triangles.size())));
    }
  }
}

TEST(RatedTessellation, HasAsManySegmentsAsAsked) {
  // A square of rates 3, 5, 2, 1; a pentagon whose odd rates become even.
  const Mesh square = testing::grid(1, 1);
  const LimitMap surface(find_scheme("catmull-clark").value(), square);
  std::vector<Index> rates{3, 5, 2, 1};
  const Tessellation made = tessellate_by_rates(surface, square.positions, rates);
  std::array<int, 4> on{};
  for (const Place& s : made.places) {
    on[0] += s.v == 0, on[1] += s.u == 1, on[2] += s.v == 1, on[3] += s.u == 0;
  }
  EXPECT_EQ(on, (std::array<int, 4>{4, 6, 3, 2}));
  const Mesh pentagon = testing::make_mesh({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}}, {{0, 1, 2, 3, 4}});
  const LimitMap polygon(find_scheme("catmull-clark").value(), pentagon);
  rates = {1, 2, 3, 4, 5};
  int border = 0;
  for (const Place& s : tessellate_by_rates(polygon, pentagon.positions, rates).places) border += s.u == 0 || s.v == 0;
  EXPECT_EQ(border, 2 + 2 + 4 + 4 + 6);
}

TEST(RatedTessellation, RefusesInClearWords) {
  const Mesh cube = testing::cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), cube);
  std::vector<Index> rates(12, 1);
  EXPECT_EQ(tessellate_by_rates(surface, cube.positions, rates).triangles.size(), 12u);
  EXPECT_THROW(tessellate_by_rates(surface, cube.positions, std::span(rates).first(11)), InvalidParameter);
  rates[3] = 0;
  EXPECT_THROW(tessellate_by_rates(surface, cube.positions, rates), InvalidParameter);
  rates.assign(12, 4000000);
  EXPECT_THROW(tessellate_by_rates(surface, cube.positions, rates), ResourceError);
}

}  // namespace
}  // namespace sublimit

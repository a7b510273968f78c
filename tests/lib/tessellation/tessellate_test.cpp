// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/tessellate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/tessellation/detail/edge_rates.h"
#include "support/tolerance.h"
#include "truth/triangle_checks.h"

namespace sublimit {
namespace {

using testing::TriangleEdges, testing::NamedMesh, testing::other_route, testing::rounding;

double diagonal(const Mesh& mesh) { return testing::diagonal(mesh.positions); }

double largest_distance(const Tessellation& t, const LimitMap& surface, const Points& control) {
  return testing::largest_distance(t, surface.faces().triangles, [&](const std::vector<Place>& at) {
    return surface.evaluate(control, at).position;
  });
}

std::vector<NamedMesh> closed_meshes() {
  std::vector<NamedMesh> all;
  const auto add = [&](const char* name, std::vector<std::string> schemes, Mesh mesh) {
    all.push_back({name, std::move(schemes), testing::jittered(std::move(mesh))});
  };
  add("cube", {"catmull-clark", "bilinear", "doo-sabin", "averaging"}, testing::cube());
  add("prism5", {"catmull-clark", "doo-sabin"}, testing::prism(5));  // pentagons beside quadrilaterals
  add("torus", {"catmull-clark", "doo-sabin", "averaging"}, testing::torus(7, 5));
  add("tetrahedron", {"catmull-clark", "loop"}, testing::tetrahedron());
  add("icosahedron", {"loop", "loop-warren"}, testing::icosahedron());
  add("triangle_torus", {"loop"}, testing::triangle_torus(6, 5));
  Mesh creased = testing::cube();
  testing::add_crease(creased, {0, 1, 3}, 10);
  testing::add_crease(creased, {4, 5, 7, 6, 4}, 1.5);
  add("creased", {"catmull-clark", "bilinear"}, creased);
  return all;
}

TEST(Tessellate, KeepsItsDistanceAndClosesClosedMeshes) {
  for (const NamedMesh& m : closed_meshes())
    for (const std::string& name : m.schemes) {
      const LimitMap surface(find_scheme(name).value(), m.mesh);
      for (const double part : {0.1, 0.01, 0.001}) {
        SCOPED_TRACE(m.name + " " + name + " " + std::to_string(part));
        const double chord = part * diagonal(m.mesh);
        const Tessellation t = tessellate(surface, m.mesh.positions, {.chord = chord});
        EXPECT_LE(t.bound, chord);
        EXPECT_LE(largest_distance(t, surface, m.mesh.positions), t.bound + other_route * diagonal(m.mesh));
        const TriangleEdges edges(t);
        EXPECT_TRUE(edges.is_manifold());
        EXPECT_EQ(edges.open(), 0);
        const Topology topology(view(m.mesh));
        EXPECT_EQ(edges.euler, topology.num_vertices() - topology.num_edges() + topology.num_faces());
      }
    }
}

// Rates beside a chord: edges have more segments where they need them, and all that holds of chords holds.
TEST(Tessellate, CutsEdgesAsOftenAsTheirRatesAtLeast) {
  std::mt19937 random(5);
  for (const NamedMesh& m : closed_meshes())
    for (const std::string& name : m.schemes) {
      SCOPED_TRACE(m.name + " " + name);
      const LimitMap surface(find_scheme(name).value(), m.mesh);
      const Topology& topology = surface.level().topology();
      TessellationOptions options{.chord = 0.05 * diagonal(m.mesh)};
      for (Index e = 0; e < topology.num_edges(); ++e) options.rates.push_back(1 + Index(random() % 9));
      const Tessellation t = tessellate(surface, m.mesh.positions, options);
      EXPECT_LE(t.bound, options.chord);
      EXPECT_LE(largest_distance(t, surface, m.mesh.positions), t.bound + other_route * diagonal(m.mesh));
      const TriangleEdges edges(t);
      EXPECT_TRUE(edges.is_manifold());
      EXPECT_EQ(edges.open(), 0);
      // Places on each side of each address, as parameters along it.
      std::map<std::pair<Index, size_t>, std::set<double>> on_side;
      const bool triangle = surface.faces().triangles;
      for (const Tessellation::Triangle& made : t.triangles)
        for (const auto& [u, v] : made.uv) {
          if (v == 0) on_side[{made.face, 0}].insert(u);
          if (triangle ? u + v == 1 : u == 1) on_side[{made.face, 1}].insert(v);
          if (v == 1 && !triangle) on_side[{made.face, 2}].insert(u);
          if (u == 0) on_side[{made.face, triangle ? 2 : 3}].insert(v);
        }
      for (Index a = 0; a < surface.faces().size; ++a) {
        const std::array<SideEdge, 4> sides = side_edges(topology, surface.addresses(), a);
        for (size_t s = 0; s < (triangle ? 3 : 4); ++s) {
          if (sides[s].of == SideEdge::Of::none) continue;
          const Index segments = Index(on_side.at({a, s}).size()) - 1,
                      rate = options.rates[size_t(index(sides[s].edge))];
          EXPECT_GE(sides[s].of == SideEdge::Of::whole ? segments : 2 * segments, rate);
        }
      }
    }
  const Mesh cube = testing::cube();
  const LimitMap flat(find_scheme("bilinear").value(), cube);
  EXPECT_EQ(tessellate(flat, cube.positions, {.chord = 1, .rates = std::vector<Index>(12, 1)}).triangles.size(), 12u);
  EXPECT_EQ(tessellate(flat, cube.positions, {.chord = 1, .rates = std::vector<Index>(12, 3)}).triangles.size(),
            6u * 32);
  EXPECT_THROW(tessellate(flat, cube.positions, {.chord = 1, .rates = {1, 2}}), InvalidParameter);
  EXPECT_THROW(tessellate(flat, cube.positions, {.chord = 1, .rates = std::vector<Index>(12, 0)}), InvalidParameter);
}

// What lies between triangles and the limit has at most the area times the distance.
TEST(Tessellate, HasTheVolumeOfTheLimit) {
  const Mesh mesh = testing::jittered(testing::cube());
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const LimitIntegrals exact = limit_integrals(surface, mesh.positions);
  for (const double chord : {1e-2, 1e-3}) {
    const Tessellation t = tessellate(surface, mesh.positions, {.chord = chord});
    double volume = 0;
    for (const Tessellation::Triangle& triangle : t.triangles) {
      const auto p = [&](size_t k) { return Eigen::Vector3d(t.points.row(triangle.vertices[k])); };
      volume += p(0).dot(p(1).cross(p(2))) / 6;
    }
    EXPECT_NEAR(volume, exact.solid->volume, exact.area * chord);
  }
}

TEST(Tessellate, OpensAtBordersAndHolesAlone) {
  Mesh grid = testing::grid(4, 3);
  const LimitMap surface(find_scheme("catmull-clark").value(), grid);
  const Tessellation t = tessellate(surface, grid.positions, {.chord = 1e-3});
  const TriangleEdges edges(t);
  EXPECT_TRUE(edges.is_manifold());
  EXPECT_EQ(edges.euler, 1);
  for (const auto& [edge, times] : edges.directed) {
    if (edges.directed.contains({edge.second, edge.first})) continue;
    // Both ends are on the border of their faces: u or v is 0 or 1.
    for (const Index v : {edge.first, edge.second}) {
      const Place& s = t.places[size_t(v)];
      EXPECT_TRUE(s.u == 0 || s.u == 1 || s.v == 0 || s.v == 1);
    }
  }
  grid.holes = {5};
  const LimitMap with_hole(find_scheme("catmull-clark").value(), grid);
  const Tessellation u = tessellate(with_hole, grid.positions, {.chord = 1e-3});
  EXPECT_TRUE(std::ranges::none_of(u.triangles, [](const auto& triangle) { return triangle.face == 5; }));
  EXPECT_EQ(TriangleEdges(u).euler, 0);
}

TEST(Tessellate, SharesPointsOfNonManifoldEdges) {
  // Three squares at an edge.
  const Mesh book = testing::make_mesh(
      {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.2}, {1, 1, 0}, {-1, 0, 1}, {-1, 1, 0.5}, {-1, 0, -1}, {-1, 1, -1}},
      {{0, 2, 3, 1}, {1, 5, 4, 0}, {0, 6, 7, 1}});
  const LimitMap surface(find_scheme("catmull-clark").value(), book);
  const Tessellation t = tessellate(surface, book.positions, {.chord = 1e-3});
  EXPECT_LE(largest_distance(t, surface, book.positions), t.bound + other_route * diagonal(book));
  std::set<std::array<double, 3>> points;
  for (Index i = 0; i < t.points.rows(); ++i) points.insert({t.points(i, 0), t.points(i, 1), t.points(i, 2)});
  EXPECT_EQ(std::ssize(points), t.points.rows());  // no point twice
}

TEST(Tessellate, TakesTwoTrianglesForAPlaneFace) {
  const Mesh cube = testing::cube();
  const LimitMap surface(find_scheme("bilinear").value(), cube);
  const Tessellation t = tessellate(surface, cube.positions, {.chord = 1e-9});
  EXPECT_EQ(t.triangles.size(), 12u);
  EXPECT_EQ(t.places.size(), 8u);
  EXPECT_LE(t.bound, rounding(4));
}

TEST(Tessellate, HalvesTheDistanceForTwiceTheTriangles) {
  // Of a smooth surface the distance goes with the square of a cell's size: 16 times the triangles for 1/16, but for
  // steps of four and what extraordinary vertices add.
  const Mesh torus = testing::torus(12, 9);
  const LimitMap surface(find_scheme("catmull-clark").value(), torus);
  const auto count = [&](double chord) {
    return double(tessellate(surface, torus.positions, {.chord = chord}).triangles.size());
  };
  constexpr double of_steps = 4;  // as said above
  EXPECT_NEAR(count(1e-4) / count(1.6e-3), 16, of_steps);
}

TEST(Tessellate, KeepsNormalsOfACellTogether) {
  const Mesh torus = testing::torus(6, 5);
  const LimitMap surface(find_scheme("catmull-clark").value(), torus);
  const double angle = 10 * std::numbers::pi / 180;
  const Tessellation t = tessellate(surface, torus.positions, {.chord = 10, .angle = angle});
  EXPECT_GT(t.triangles.size(), 60u);
  std::vector<Place> at;
  for (const Tessellation::Triangle& triangle : t.triangles)
    for (const auto& [u, v] : triangle.uv) at.push_back({triangle.face, u, v});
  const Points normals = surface.evaluate(torus.positions, at, 1).normal;
  for (Index i = 0; i < normals.rows(); i += 3)
    for (Index k = 0; k < 3; ++k)
      EXPECT_LE(std::acos(std::min(1.0, normals.row(i + k).dot(normals.row(i + (k + 1) % 3)))), angle);
}

TEST(Tessellate, TakesAsManyTrianglesFarFromTheOrigin) {
  const Mesh near = testing::jittered(testing::prism(5));
  const LimitMap surface(find_scheme("catmull-clark").value(), near);
  const TessellationOptions options{.chord = 1e-3 * diagonal(near)};
  Points far = near.positions;
  far.array() += 1e6;
  const Tessellation a = tessellate(surface, near.positions, options), b = tessellate(surface, far, options);
  EXPECT_EQ(TriangleEdges(b).euler, 2);
  EXPECT_NEAR(double(b.triangles.size()), double(a.triangles.size()), 0.01 * double(a.triangles.size()));
}

TEST(Tessellate, HasTheSameBitsForAnyNumberOfThreads) {
  const Mesh mesh = testing::quads_from_triangles(testing::triangle_torus(8, 6));
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  const Tessellation a = tessellate(surface, mesh.positions, {.chord = 1e-3});
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Tessellation b = tessellate(surface, mesh.positions, {.chord = 1e-3});
  EXPECT_EQ(a.points, b.points);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (size_t i = 0; i < a.triangles.size(); ++i) EXPECT_EQ(a.triangles[i].vertices, b.triangles[i].vertices);
}

TEST(Tessellate, RefusesInClearWords) {
  const Mesh cube = testing::cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), cube);
  for (const double chord : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(tessellate(surface, cube.positions, {.chord = chord}), InvalidParameter);
  EXPECT_THROW(tessellate(surface, cube.positions, {.chord = 1, .angle = -1}), InvalidParameter);
  EXPECT_THROW(tessellate(surface, Points::Zero(3, 3), {.chord = 1}), InvalidParameter);
  EXPECT_THROW(tessellate(surface, cube.positions, {.chord = 1e-6, .max_triangles = 1000}), ResourceError);
  const Mesh triangles = testing::icosahedron();
  const LimitMap butterfly(find_scheme("modified-butterfly").value(), triangles);
  EXPECT_THROW(tessellate(butterfly, triangles.positions, {.chord = 0.1}), UnsupportedTopology);
  // Polynomials, but hulls with negative weights around them.
  const LimitMap habib_warren(find_scheme("mid-edge-habib-warren").value(), cube);
  EXPECT_THROW(tessellate(habib_warren, cube.positions, {.chord = 0.1}), UnsupportedTopology);
  Mesh nothing;
  nothing.positions = Points::Zero(0, 3);
  EXPECT_TRUE(tessellate(LimitMap(find_scheme("catmull-clark").value(), nothing), nothing.positions, {.chord = 1})
                  .triangles.empty());
}

}  // namespace
}  // namespace sublimit

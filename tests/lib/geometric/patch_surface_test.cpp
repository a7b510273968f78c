// SPDX-License-Identifier: Apache-2.0
// Meshes of patches through points with normals, by every scheme of the registry: what data they take, the surface
// anywhere, points of levels.
#include "sublimit/geometric/patch_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/meshes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/splits/split.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// Of patches of size 1.
constexpr double patch_tolerance = 1e-13;

/// A mesh around the origin, with normals away from it.
NormalMesh around_origin(const Mesh& mesh) {
  Points normals = mesh.positions;
  normals.rowwise().normalize();
  return normal_mesh(mesh, normals);
}

const std::vector<GeometricNormalScheme>& schemes() {
  static const std::vector<GeometricNormalScheme> all = all_geometric_schemes<NormalMesh>();
  return all;
}

LimitSamples evaluated(const GeometricNormalScheme& scheme, const NormalMesh& mesh, const std::vector<Place>& places,
                       int order) {
  LimitSamples found;
  scheme.surface(mesh)->evaluate(places, order, true, found);
  return found;
}

TEST(PatchSurface, EveryPlaceHasAnAnswer) {
  const NormalMesh mesh = checked(around_origin(jittered(icosahedron())));
  ASSERT_EQ(schemes().size(), 2u);
  for (const GeometricNormalScheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    const auto surface = scheme.surface(mesh);
    EXPECT_EQ(surface->faces().size, 20);
    EXPECT_TRUE(surface->faces().triangles);
    const std::vector<Place> places = grid_places(surface->faces(), 5);
    ASSERT_EQ(places.size(), 20u * 15);
    const LimitSamples found = evaluated(scheme, mesh, places, 2);
    for (size_t i = 0; i < places.size(); ++i) {
      const auto row = Eigen::Index(i);
      const Vector3d x = found.position.row(row), n = found.normal.row(row);
      EXPECT_NEAR(n.norm(), 1, rounding(4));
      EXPECT_GT(n.dot(x), 0.5);  // outwards, as faces are wound
      const double b[] = {1 - places[i].u - places[i].v, places[i].u, places[i].v};
      for (int c = 0; c < 3; ++c) {
        if (b[c] != 1) continue;
        const Index v = mesh.triangles[size_t(3 * places[i].face + c)];
        EXPECT_EQ(Vector3d(x), Vector3d(mesh.positions.row(v)));
        EXPECT_LE((n - Vector3d(mesh.normals.row(v))).norm(), patch_tolerance);
      }
    }
    // Absent quantities and places outside.
    const LimitSamples few = evaluated(scheme, mesh, {{0, 0.25, 0.25}, {20, 0, 0}, {0, 0.6, 0.6}, {-1, 0, 0}}, 0);
    EXPECT_EQ(few.du.rows() + few.normal.rows(), 0);
    EXPECT_EQ(few.status[0], LimitStatus::regular);
    for (int i = 1; i < 4; ++i) EXPECT_EQ(few.status[size_t(i)], LimitStatus::outside);
    expect_error<InvalidParameter>([&] { evaluated(scheme, mesh, {{0, 0, 0}}, 3); }, {"order 3"});
  }
}

TEST(PatchSurface, IsG1AcrossAllEdges) {
  const NormalMesh mesh = checked(around_origin(jittered(icosahedron())));
  const Topology topology(view(mesh));
  const std::array<std::array<double, 2>, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
  const auto place = [&](HalfEdge h, double s) {
    const auto& a = corner[size_t(topology.corner_index(h))];
    const auto& b = corner[size_t(topology.corner_index(topology.next(h)))];
    return Place{index(topology.face(h)), (1 - s) * a[0] + s * b[0], (1 - s) * a[1] + s * b[1]};
  };
  std::vector<Place> places;
  for (Index e = 0; e < topology.num_edges(); ++e)
    for (const double s : {0.0, 0.125, 0.5, 0.75}) {
      const HalfEdge h = topology.half_edge(Edge{e});
      places.push_back(place(h, s));
      places.push_back(place(topology.twin(h), 1 - s));
    }
  for (const GeometricNormalScheme& scheme : schemes()) {
    const LimitSamples found = evaluated(scheme, mesh, places, 1);
    for (Eigen::Index i = 0; i < found.position.rows(); i += 2) {
      EXPECT_LE((found.position.row(i) - found.position.row(i + 1)).norm(), patch_tolerance) << scheme.name;
      EXPECT_LE((found.normal.row(i) - found.normal.row(i + 1)).norm(), patch_tolerance) << scheme.name;
    }
  }
}

TEST(PatchSurface, LevelsAreOnIt) {
  const NormalMesh mesh = checked(around_origin(jittered(octahedron())));
  for (const GeometricNormalScheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    const NormalMesh same = scheme.limit(mesh, 0), level = scheme.limit(mesh, 2);
    EXPECT_EQ(same.positions, mesh.positions);
    EXPECT_EQ(same.normals, mesh.normals);
    EXPECT_EQ(same.triangles, mesh.triangles);
    // Vertices and faces as refinement numbers them; old ones bitwise.
    const Refinement first = refine(Topology(view(mesh)), Split::ptq), second = refine(first.topology, Split::ptq);
    ASSERT_EQ(level.num_vertices(), second.topology.num_vertices());
    for (Index f = 0; f < second.topology.num_faces(); ++f)
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(level.triangles[size_t(3 * f + i)], second.topology.vertices(Face{f})[size_t(i)]);
    EXPECT_EQ(level.positions.topRows(6), mesh.positions);
    EXPECT_EQ(level.normals.topRows(6), mesh.normals);
    // Level 1 in level 2, and every face where its parent has it: corner i of child c of child d.
    const NormalMesh once = scheme.limit(mesh, 1);
    EXPECT_EQ(level.positions.topRows(once.num_vertices()), once.positions);
    std::vector<Place> places;
    for (Index f = 0; f < mesh.num_faces(); ++f) places.push_back({f, 0.25, 0.5});
    const LimitSamples found = evaluated(scheme, mesh, places, 1);
    for (Index f = 0; f < mesh.num_faces(); ++f) {
      // (1/4, 1/2) is the middle of the edge between (1/2, 1/2) and (0, 1/2): a corner of the middle triangle's child.
      double nearest = 1;
      for (Index t = 16 * f; t < 16 * f + 16; ++t)
        for (int i = 0; i < 3; ++i) {
          const Index v = level.triangles[size_t(3 * t + i)];
          nearest = std::min(nearest, (level.positions.row(v) - found.position.row(f)).norm() +
                                          (level.normals.row(v) - found.normal.row(f)).norm());
        }
      EXPECT_LE(nearest, patch_tolerance);
    }
    EXPECT_LE((level.normals.rowwise().norm().array() - 1).abs().maxCoeff(), rounding(4));
    expect_error<InvalidParameter>([&] { scheme.limit(mesh, -1); }, {"-1"});
    expect_error<ResourceError>([&] { scheme.limit(mesh, 40); }, {"40 levels of 8 triangles", "at most"});
  }
}

TEST(PatchSurface, NormalsStayOnTheirSide) {
  NormalMesh mesh = around_origin(octahedron());
  const GeometricNormalScheme scheme = nielson({});
  EXPECT_TRUE(scheme.notes(checked(mesh)).empty());
  mesh.normals = -mesh.normals;
  mesh = checked(mesh);
  for (const bool against : wound_against_normals(mesh)) EXPECT_TRUE(against);
  ASSERT_EQ(scheme.notes(mesh).size(), 1u);
  EXPECT_NE(scheme.notes(mesh)[0].find("8 of 8 triangles are wound against"), std::string::npos);
  const NormalMesh level = scheme.limit(mesh, 2);
  for (Index v = 0; v < level.num_vertices(); ++v) EXPECT_LT(level.normals.row(v).dot(level.positions.row(v)), -0.9);
}

TEST(PatchSurface, TakesAnyTopology) {
  // Two triangles on the same side of an edge, a vertex without a face, a border.
  Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}, {9, 9, 9}}, {{0, 1, 2}, {0, 1, 3}});
  Points normals = Points::Zero(5, 3);
  normals.topRows(4) << -0.2, 0, 1, 0.3, 0, 1, 0, 0.1, 1, 0, -1, 1;
  for (const GeometricNormalScheme& scheme : schemes()) {
    const NormalMesh level = scheme.limit(scheme.checked(normal_mesh(mesh, normals)), 1);
    EXPECT_EQ(level.num_vertices(), 5 + 5);
    EXPECT_EQ(level.positions.row(4), mesh.positions.row(4));
  }
}

TEST(PatchSurface, EstimatesNormals) {
  // By angles: of a cube's corner the mean of three faces, however they are cut.
  const Mesh box = triangulated(cube());
  const Points normals = estimated_normals(normal_mesh(box, {}));
  for (Index v = 0; v < 8; ++v)
    EXPECT_LE((normals.row(v) - box.positions.row(v).normalized()).norm(), rounding(8)) << v;
  for (const char* name : {"nielson", "piper"}) {
    const auto scheme = find_geometric_scheme<NormalMesh>(name, {{"normals", "estimated"}});
    ASSERT_TRUE(scheme);
    const NormalMesh data = scheme->checked(normal_mesh(box, {}));
    EXPECT_LE((data.normals - normals).norm(), rounding(8));
    expect_error<InvalidMesh>([&] { find_geometric_scheme<NormalMesh>(name)->checked(normal_mesh(box, {})); },
                              {"no normals", "vn", "normals=estimated"});
    expect_error<InvalidOption>(
        [&] {
          find_geometric_scheme<NormalMesh>(name, {{"normals", "none"}});
        },
        {"normals", "given, estimated"});
    expect_error<InvalidMesh>([&] { scheme->checked({{0, 1, 7}, Points::Zero(2, 3), {}}); }, {"vertex 7", "0 to 1"});
  }
}

TEST(PatchSurface, RefusesDataThatHaveNoSurface) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
  Points up = Points::Zero(4, 3);
  up.col(2).setOnes();
  const auto refused = [&](Index v, const Vector3d& normal, std::initializer_list<std::string_view> parts) {
    NormalMesh data = normal_mesh(mesh, up);
    data.normals.row(v) = normal;
    for (const GeometricNormalScheme& scheme : schemes())
      expect_error<InvalidMesh>([&] { scheme.checked(data); }, parts);
  };
  refused(2, {0, nan, 1}, {"vertex 2", "normal is not finite"});
  refused(3, {0, infinity, 1}, {"vertex 3", "normal is not finite"});
  refused(1, {0, 0, 0}, {"vertex 1", "length 0"});
  refused(1, {3, 0, 0}, {"face 0, edge (0,1)", "normal of vertex 1", "along the edge"});
  refused(3, {0, 2, 0}, {"face 1, edge (1,3)", "normal of vertex 3", "along the edge"});
  refused(0, {0, 0, -1}, {"face 0, edge (0,1)", "opposite"});
  const auto moved = [&](Index v, const Vector3d& x, std::initializer_list<std::string_view> parts) {
    NormalMesh data = normal_mesh(mesh, up);
    data.positions.row(v) = x;
    expect_error<InvalidMesh>([&] { checked(data); }, parts);
  };
  moved(3, {0, nan, 0}, {"vertex 3", "position is not finite"});
  moved(3, {1, 0, 0}, {"face 1, edge (1,3)", "same place"});
  NormalMesh far = normal_mesh(mesh, up);
  far.positions *= 1.5e308;
  far.positions.row(0) << -1.5e308, 0, 0;
  expect_error<InvalidMesh>([&] { checked(far); }, {"face 0, edge (0,1)", "too far apart"});

  expect_error<InvalidMesh>([&] { checked(NormalMesh{{}, mesh.positions, up}); }, {"no faces"});
  expect_error<InvalidMesh>([&] { checked(NormalMesh{{0, 1}, mesh.positions, up}); }, {"2 corners"});
  expect_error<InvalidMesh>([&] { checked(NormalMesh{{0, 1, 4}, mesh.positions, up}); }, {"vertex 4", "0 to 3"});
  expect_error<InvalidMesh>([&] { checked(NormalMesh{{0, 1, 2}, mesh.positions, up.topRows(3)}); }, {"3 normals"});
  expect_error<InvalidMesh>([&] { normal_mesh(mesh, up.topRows(2)); }, {"2 normals for 4 vertices"});
  expect_error<UnsupportedTopology>([&] { normal_mesh(cube(), {}); }, {"face 0 has 4 corners", "triangulate the mesh"});
  Mesh holed = mesh;
  holed.holes = {1};
  expect_error<InvalidMesh>([&] { normal_mesh(holed, up); }, {"face 1 is a hole"});

  // Lengths other than 1 are made 1; what is 1 keeps its bits; what no face has is not looked at.
  NormalMesh data = normal_mesh(mesh, 1e-300 * up);
  EXPECT_EQ(checked(data).normals, up);
  Points unit = up;
  unit.row(1) << 0.6, 0, 0.8;
  EXPECT_EQ(checked(normal_mesh(mesh, unit)).normals, unit);
  data.triangles = {0, 1, 2};
  data.normals.row(3).setZero();
  EXPECT_NO_THROW(checked(data));
}

TEST(PatchSurface, SeveralAreOne) {
  const NormalMesh two = checked(around_origin(jittered(tetrahedron()))),
                   other = checked(around_origin(jittered(octahedron())));
  const auto first = schemes()[0].surface(two), second = schemes()[1].surface(other);
  const auto both = placed_together({first, second});
  EXPECT_EQ(both->faces().size, 12);
  EXPECT_TRUE(both->faces().triangles);
  std::vector<Place> places = grid_places(both->faces(), 4), of_second;
  std::reverse(places.begin(), places.end());
  for (const int order : {0, 2}) {
    LimitSamples found, alone;
    both->evaluate(places, order, true, found);
    for (size_t i = 0; i < places.size(); ++i) {
      Place own = places[i];
      const bool is_first = own.face < 4;
      if (!is_first) own.face -= 4;
      (is_first ? first : second)->evaluate({&own, 1}, order, true, alone);
      const auto row = Eigen::Index(i);
      EXPECT_EQ(found.status[i], alone.status[0]);
      EXPECT_EQ(found.order[i], alone.order[0]);
      EXPECT_EQ(found.position.row(row), alone.position.row(0));
      if (order < 2) continue;
      EXPECT_EQ(found.duv.row(row), alone.duv.row(0));
      EXPECT_EQ(found.normal.row(row), alone.normal.row(0));
    }
  }
  // Places of one of them alone, and of none.
  of_second = {{11, 0.25, 0.25}, {12, 0.25, 0.25}, {-1, 0.25, 0.25}};
  LimitSamples found;
  both->evaluate(of_second, 1, true, found);
  EXPECT_NE(found.status[0], LimitStatus::outside);
  EXPECT_EQ(found.status[1], LimitStatus::outside);
  EXPECT_EQ(found.status[2], LimitStatus::outside);
  EXPECT_EQ(found.normal.rows(), 3);
  EXPECT_EQ(placed_together({first}), first);
  expect_error<InvalidParameter>([] { placed_together({}); }, {"one at least"});
}

}  // namespace
}  // namespace sublimit::testing

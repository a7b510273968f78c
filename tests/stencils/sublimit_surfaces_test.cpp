// SPDX-License-Identifier: Apache-2.0
// Surfaces of sublimit.h that are not of meshes alone: recipes and patches, triangles as meshes, dictionaries, lists.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "laws/tested_schemes.h"
#include "meshes/meshes.h"
#include "sublimit/base/version.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/sublimit.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

constexpr double some_roundings = 1e-14;  // a few products of numbers of order 1

/// The unit sphere, rational: a half circle, turned around z.
constexpr const char* sphere = R"json({"kind": "revolution", "profile": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1],
  "homogeneous_xzw": [[0, -1, 1], [1, 0, 0], [0, 1, 1]]}})json";
constexpr const char* parabola =
    R"json({"kind": "bezier_curve", "degree": 2, "points": [[0, 0, 0], [1, 2, 0], [2, 0, 0]]})json";
constexpr const char* saddle =
    R"json({"kind": "bezier_surface", "degree": [1, 1], "points": [[0, 0, 0], [1, 0, 1], [0, 1, 1], [1, 1, 0]]})json";

double difference(const Points& a, const Points& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return std::numeric_limits<double>::infinity();
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

TEST(Construct, MakesCurvesOfTheirClosedForm) {
  const Construction made = construct(parabola);
  ASSERT_EQ(made.names().size(), 1u);
  const Curves curves = made.curves();
  ASSERT_EQ(curves.num_segments(), 1);
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const CurveSamples at = curves.evaluate({{.segment = 0, .t = t}}, 2);
    EXPECT_LE((at.position.row(0) - Eigen::RowVector3d(2 * t, 4 * t * (1 - t), 0)).norm(), some_roundings);
    EXPECT_LE((at.first.row(0) - Eigen::RowVector3d(2, 4 - 8 * t, 0)).norm(), some_roundings);
    EXPECT_LE((at.second.row(0) - Eigen::RowVector3d(0, -8, 0)).norm(), some_roundings);
  }
  expect_error<UnsupportedTopology>([&] { (void)made.surfaces(); }, {"surface"});
  expect_error<InvalidParameter>([&] { (void)curves.evaluate({{.segment = 1, .t = 0}}); }, {"1"});
}

TEST(Construct, MakesPatchesThatSurfacesAreEvaluatedOf) {
  const Patches patches = construct(saddle).surfaces();
  ASSERT_EQ(patches.faces().size, 1);
  EXPECT_FALSE(patches.rational());
  const std::vector<Place> places = patches.grid(4);
  const LimitSamples all = patches.evaluate(places, 2);
  const PlaceStencils rows = patches.stencils(places);
  for (size_t i = 0; i < places.size(); ++i) {
    const auto [face, u, v] = places[i];
    const double z = u * (1 - v) + v * (1 - u);
    const Eigen::RowVector3d here = all.position.row(Index(i));
    EXPECT_LE(std::abs(here.z() - here.x() * (1 - here.y()) - here.y() * (1 - here.x())), some_roundings);
    EXPECT_LE(std::abs(here.z() - z), some_roundings);
  }
  EXPECT_LE(difference(rows.matrices[0] * patches.points(), all.position), some_roundings);
  const Patches moved = patches.with(patches.points().array() + 1);
  EXPECT_LE(difference(moved.evaluate(places).position, all.position.array() + 1), 2 * some_roundings);
  expect_error<InvalidParameter>([&] { (void)patches.with(Points::Zero(3, 3)); }, {"3"});
  const LimitSamples outside = patches.evaluate({{0, 0.5, 0.5}, {1, 0, 0}, {0, 2, 0}}, 1);
  EXPECT_EQ(outside.status[0], LimitStatus::regular);
  EXPECT_EQ(outside.status[1], LimitStatus::outside);
  EXPECT_EQ(outside.status[2], LimitStatus::outside);
  EXPECT_TRUE(outside.position.row(2).isZero(0));
  EXPECT_EQ(patches.first_face(1), 1);
  expect_error<InvalidParameter>([&] { (void)patches.first_face(2); }, {"2"});

  const Table table = bake(patches, {.grid = 4, .in_double = true});
  std::vector<double> result(table.num_results(3));
  table.apply({patches.points().data(), size_t(patches.points().size())}, 3, result);
  for (Index i = 0; i < all.position.size(); ++i)
    EXPECT_LE(std::abs(result[size_t(i)] - all.position.data()[i]), some_roundings);
  expect_error<InvalidParameter>([&] { (void)bake(patches, {}); }, {"one of levels, grid and at"});
}

TEST(Construct, PatchesAreSearchedAsLimitsAre) {
  const Patches ball = construct(sphere).surfaces();
  EXPECT_TRUE(ball.rational());
  const Points queries{{3, 0, 0}, {0.1, 0.2, 2}, {0, 0.5, 0.25}};
  const ClosestPoints near = closest(ball, queries);
  for (Index i = 0; i < queries.rows(); ++i) {
    EXPECT_LE((near.points.row(i) - queries.row(i).normalized()).norm(), 1e-11);
    EXPECT_LE(std::abs(near.distances[i] - std::abs(queries.row(i).norm() - 1)), 1e-12);
  }
  EXPECT_EQ(ball.closest(queries).points, near.points);
  const RayHits hits = ball.intersect({{.origin = {0.25, 0.5, -9}, .direction = {0, 0, 1}}}, {.all = true});
  ASSERT_EQ(hits.t.size(), 2u);
  EXPECT_LE(std::abs(hits.points(0, 2) + std::sqrt(1 - 0.3125)), 1e-12);
  EXPECT_LE(std::abs(hits.points(1, 2) - std::sqrt(1 - 0.3125)), 1e-12);
}

TEST(Construct, WritesNetsThatAreReadAgain) {
  const TemporaryDirectory directory;
  const Construction made = construct(saddle);
  made.write(directory / "saddle.obj");
  const Patches again = construct((directory / "saddle.obj").string()).surfaces(), before = made.surfaces();
  EXPECT_LE(difference(again.evaluate(again.grid(5)).position, before.evaluate(before.grid(5)).position),
            some_roundings);
  expect_error<InvalidOption>([&] { made.write(directory / "saddle.ply"); }, {".obj"});
  expect_error<IoError>([&] { (void)construct("there is no such.json"); }, {"there is no such.json"});
  expect_error<FormatError>([&] { (void)construct(R"json({"kind": "conee"})json"); }, {"conee", "cone"});
  expect_error<FormatError>([&] { (void)construct("{"); }, {"recipe"});
}

TEST(Schemes, AreListedWithWhatTheyTake) {
  const std::vector<SchemeInfo> all = schemes();
  std::set<std::string> names;
  for (const SchemeInfo& scheme : all) {
    SCOPED_TRACE(scheme.name);
    EXPECT_TRUE(names.insert(scheme.name).second);
    EXPECT_FALSE(scheme.source.empty());
    if (scheme.kind != SchemeInfo::Kind::surface || !scheme.linear) continue;
    const AnyScheme made(scheme.name);
    EXPECT_EQ(scheme.triangles, made->face_size() == 3);
    for (const OptionInfo& option : scheme.options)
      EXPECT_EQ(AnyScheme(scheme.name, {{option.name, option.values.front()}})->name, made->name);
  }
  for (const Scheme<double>& scheme : all_schemes()) EXPECT_TRUE(names.contains(scheme.name)) << scheme.name;
}

TEST(Verbs, TrianglesAreAMeshWithNormalsAndTextureCoordinates) {
  Mesh mesh = cube();
  mesh.face_varying.push_back({.name = "uv", .values = Points(4, 2), .indices = {}});
  mesh.face_varying[0].values << 0, 0, 1, 0, 1, 1, 0, 1;
  for (Index f = 0; f < mesh.num_faces(); ++f)
    for (Index k = 0; k < 4; ++k) mesh.face_varying[0].indices.push_back(k);
  const Mesh triangles = tessellate(mesh, "catmull-clark", {.chord = 0.05, .normals = true});
  const LimitSurface surface(mesh, "catmull-clark");
  const Tessellation made = surface.tessellate({.chord = 0.05, .normals = true});
  ASSERT_EQ(triangles.num_faces(), Index(made.triangles.size()));
  EXPECT_EQ(triangles.positions, made.points);
  ASSERT_EQ(triangles.face_varying.size(), 1u);
  ASSERT_EQ(triangles.face_ids.size(), made.triangles.size());
  size_t with_normals = 0;
  for (size_t t = 0; t < made.triangles.size(); ++t)
    for (size_t k = 0; k < 3; ++k) {
      const size_t corner = 3 * t + k;
      EXPECT_EQ(made.normals.row(Index(corner)), triangles.normals.row(triangles.face_normals[corner]));
      // Values that are refined linearly are the parameters of the face.
      const auto [u, v] = made.triangles[t].uv[k];
      const Points& values = triangles.face_varying[0].values;
      EXPECT_LE((values.row(triangles.face_varying[0].indices[corner]) - Eigen::RowVector2d(u, v)).norm(),
                some_roundings);
      with_normals += std::abs(triangles.normals.row(Index(corner)).norm() - 1) < some_roundings;
    }
  EXPECT_EQ(with_normals, 3 * made.triangles.size());
  expect_error<InvalidParameter>([&] { (void)tessellate(mesh, "catmull-clark", {.chord = 0}); }, {"chord", "0"});
}

TEST(Verbs, LeaveOutChannelsThatASchemeCannotRefineAndSaySo) {
  Mesh mesh = cube();
  mesh.face_varying.push_back({.name = "uv", .values = Points::Zero(4, 2), .indices = {}});
  for (Index c = 0; c < 24; ++c) mesh.face_varying[0].indices.push_back(c % 4);
  const Mesh refined = refine(mesh, "doo-sabin", 1), triangles = tessellate(mesh, "doo-sabin", {.chord = 0.1});
  for (const Mesh* const made : {&refined, &triangles}) {
    EXPECT_TRUE(made->face_varying.empty());
    ASSERT_EQ(made->warnings.size(), 1u);
    EXPECT_TRUE(made->warnings[0].starts_with("texture coordinates are left out: face-varying interpolation 'all'"));
    EXPECT_NE(made->warnings[0].find("doo-sabin"), std::string::npos) << made->warnings[0];
  }
  EXPECT_EQ(triangles.num_faces(), Index(LimitSurface(mesh, "doo-sabin").tessellate({.chord = 0.1}).triangles.size()));
}

TEST(Verbs, RefineAllChannels) {
  Mesh mesh = cube();
  for (const double scale : {1.0, 2.0}) {
    mesh.face_varying.push_back({.name = "uv" + std::to_string(int(scale)), .values = Points(4, 2), .indices = {}});
    mesh.face_varying.back().values << 0, 0, scale, 0, scale, scale, 0, scale;
    for (Index c = 0; c < 24; ++c) mesh.face_varying.back().indices.push_back(c % 4);
  }
  const Mesh fine = refine(mesh, "catmull-clark", 1);
  ASSERT_EQ(fine.face_varying.size(), 2u);
  EXPECT_EQ(fine.face_varying[1].name, "uv2");
  EXPECT_EQ(2 * fine.face_varying[0].values, fine.face_varying[1].values);
  EXPECT_EQ(fine.face_varying[0].indices.size(), fine.face_vertices.size());
  VertexTarget bent{.vertex = 0, .position = {1, 1, 1}};
  bent.curvature = TargetCurvature{};
  expect_error<InvalidParameter>([&] { (void)fit(cube(), "catmull-clark", {bent}); }, {"vertex 0", "curvature"});
}

TEST(Verbs, DictionariesAreSharedByMeshesOfOneScheme) {
  const auto cache = limit_cache("catmull-clark");
  const Limit alone = limit(cube(), "catmull-clark"), with = limit(cube(), "catmull-clark", {.cache = cache});
  EXPECT_EQ(alone.points, with.points);
  const LimitSurface surface(prism(5), "catmull-clark", cache);
  const LimitSurface other(prism(5), "catmull-clark");
  EXPECT_EQ(surface.evaluate(surface.grid(3), 1).du, other.evaluate(other.grid(3), 1).du);
  expect_error<InvalidParameter>([&] { (void)limit(octahedron(), "loop", {.cache = cache}); }, {"catmull-clark"});
}

// Tables have their points in an order of their own; `refined_points` leads to that of refinement, whatever the table
// is made of: patterns of faces, of their children, rows.
TEST(Verbs, PointsOfTablesAreFoundInTheOrderOfRefinement) {
  constexpr double products = 1e-13;  // of three levels, with sums of some tens
  for (const Scheme<double>& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name);
    std::vector<Mesh> meshes{scheme.face_size() == 3 ? octahedron() : scheme.face_size() == 4 ? cube() : prism(5)};
    if (scheme.face_size() == 3) meshes.push_back(hard_triangles(5, {.open = true, .sharp = false}));
    if (scheme.face_size() == 4 || scheme.face_size() == 0) meshes.push_back(torus(5, 4));
    for (Mesh mesh : meshes) {
      mesh = jittered(std::move(mesh));
      for (const int levels : {1, 2, 3}) {
        const Mesh fine = refine(mesh, scheme, levels);
        const Table table = bake(mesh, scheme, {.levels = levels, .in_double = true, .order = true});
        const std::span<const std::int64_t> points = table.refined_points();
        ASSERT_EQ(std::ssize(points), fine.num_vertices());
        std::vector<double> result(table.num_results(3));
        table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, result);
        for (Index v = 0; v < fine.num_vertices(); ++v) {
          ASSERT_GE(points[size_t(v)], 0);
          const Eigen::Map<const Eigen::RowVector3d> point(result.data() + 3 * points[size_t(v)]);
          ASSERT_LE((point - fine.positions.row(v)).norm(), products) << "level " << levels << ", vertex " << v;
        }
      }
    }
  }
  EXPECT_TRUE(bake(cube(), "catmull-clark", {.levels = 1}).refined_points().empty());
  expect_error<InvalidParameter>([&] { (void)bake(cube(), "catmull-clark", {.grid = 3, .order = true}); }, {"order"});
}

TEST(Verbs, InfoMeasuresTheLimit) {
  const MeshInfo known = info(cube(), "catmull-clark", {.limit = true});
  ASSERT_TRUE(known.limit.has_value());
  EXPECT_GT(known.limit->area, 0);
  EXPECT_FALSE(info(cube(), "catmull-clark").limit.has_value());
}

TEST(MakeMesh, TakesFlatArraysOfAnyStride) {
  // Positions with normals behind them, as vertex buffers have them.
  std::vector<float> buffer;
  const Mesh box = cube();
  for (Index v = 0; v < 8; ++v)
    for (Index k = 0; k < 6; ++k) buffer.push_back(k < 3 ? float(box.positions(v, k)) : 7.0F);
  const Mesh made = sublimit::make_mesh(std::span(buffer), 6, std::span(box.face_vertices), 4);
  EXPECT_EQ(made.positions, box.positions);
  EXPECT_EQ(made.face_vertices, box.face_vertices);
  EXPECT_EQ(made.face_sizes, box.face_sizes);
  EXPECT_EQ(sublimit::make_mesh(std::span(buffer).first(45), 6, std::span(box.face_vertices), 4).num_vertices(), 8);
  const std::span<const float> all(buffer);
  expect_error<InvalidParameter>([&] { (void)sublimit::make_mesh(all.first(44), 6, std::span(box.face_vertices), 4); },
                                 {"44"});
  expect_error<InvalidParameter>([&] { (void)sublimit::make_mesh(all, 2, std::span(box.face_vertices), 4); },
                                 {"stride is 2"});
  expect_error<InvalidParameter>([&] { (void)sublimit::make_mesh(all, 6, std::span(box.face_vertices), 5); },
                                 {"24", "5"});
  const Mesh moved = box.with_points(2 * box.positions);
  EXPECT_EQ(moved.positions, 2 * box.positions);
  EXPECT_EQ(moved.face_vertices, box.face_vertices);
  expect_error<InvalidParameter>([&] { (void)box.with_points(Points::Zero(7, 3)); }, {"7 x 3", "8 x 3"});
}

TEST(Version, IsThatOfTheHeader) {
  EXPECT_EQ(std::string(version()), std::to_string(SUBLIMIT_VERSION_MAJOR) + "." +
                                        std::to_string(SUBLIMIT_VERSION_MINOR) + "." +
                                        std::to_string(SUBLIMIT_VERSION_PATCH));
}

}  // namespace
}  // namespace sublimit::testing

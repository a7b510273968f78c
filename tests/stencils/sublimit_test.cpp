// SPDX-License-Identifier: Apache-2.0
// The functions of sublimit.h: what they give is what the matrices say, under every scheme; what is wrong is told.
#include "sublimit/sublimit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

constexpr double rounding = 1e-13;         // sums of some tens of products of numbers of order 1
constexpr double solved = 1e-12;           // a direct solution, or a search to the last digits, on a mesh of that size
constexpr double least_squares = 1e-10;    // normal equations lose half of the digits, refinement brings most back
constexpr double single_precision = 1e-5;  // weights and points of 24 bits, sums of some tens

double distance(const Points& a, const Points& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return std::numeric_limits<double>::infinity();
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

Mesh mesh_for(const Scheme<double>& scheme) {
  Mesh mesh = jittered(scheme.face_size() == 3 ? octahedron() : prism(5));
  if (scheme.face_size() == 4) mesh = jittered(cube());
  return mesh;
}

TEST(Verbs, AgreeWithTheMatricesUnderEveryScheme) {
  for (const Scheme<double>& scheme : all_schemes<double>()) {
    SCOPED_TRACE(scheme.name);
    const Mesh mesh = mesh_for(scheme);
    const std::vector<Level> all = levels(mesh, scheme, 2);
    const SparseMatrix P = subdivision_matrix(mesh, scheme.name, 2);
    EXPECT_LE(distance(refine(mesh, scheme, 2).positions, P * mesh.positions), rounding);
    EXPECT_LE(distance(Refiner(mesh, scheme, 2).points(mesh.positions), P * mesh.positions), rounding);
    EXPECT_LE(distance(SparseMatrix(all[2].S * all[1].S) * mesh.positions, P * mesh.positions), rounding);

    const Limit limit = sublimit::limit(mesh, scheme, {.levels = 1});
    ASSERT_EQ(limit.points.rows(), all[1].topology().num_vertices());
    EXPECT_LE(distance(limit.points, limit.matrix * mesh.positions), rounding);
    EXPECT_LE(distance(limit.tangent1, limit.tangent1_matrix * mesh.positions), rounding);
    for (Index side = 0; side < limit.normals.rows(); ++side) {
      const Eigen::Vector3d a = limit.tangent1.row(side), b = limit.tangent2.row(side);
      if (limit.status[size_t(side)] != LimitStatus::regular) continue;
      EXPECT_LE((a.cross(b).normalized() - limit.normals.row(side).transpose()).norm(), rounding);
    }

    const LimitSurface surface(mesh, scheme);
    const std::vector<Place> places = surface.grid(3);
    const PlaceStencils stencils = surface.stencils(places);
    EXPECT_LE(distance(surface.evaluate(places).position, stencils.matrices[0] * mesh.positions), rounding);
    const Table table = bake(mesh, scheme, {.grid = 3, .in_double = true});
    Points baked(table.num_points(), 3);
    table.apply({mesh.positions.data(), size_t(mesh.positions.size())}, 3, {baked.data(), size_t(baked.size())});
    EXPECT_LE(distance(surface.evaluate(places).position, baked), rounding);
  }
}

TEST(Verbs, FollowTheRulesOfTheMesh) {
  Mesh mesh = jittered(triangle_grid(3, 3));
  const Points catmark = refine(mesh, "catmull-clark", 2).positions;
  mesh.triangles = Triangles::smooth;
  const Points smooth = refine(mesh, "catmull-clark", 2).positions;
  EXPECT_GT(distance(catmark, smooth), 1e-3);
  const AnyScheme chosen("catmull-clark", {{"triangles", "smooth"}});
  EXPECT_EQ(distance(smooth, refine(mesh, chosen, 2).positions), 0);
  EXPECT_LE(distance(limit(mesh, "catmull-clark").points, limit(mesh, chosen).points), rounding);
  const std::vector<Place> places{{0, 0.25, 0.5}};
  EXPECT_EQ(distance(LimitSurface(mesh, "catmull-clark").evaluate(places).position,
                     LimitSurface(mesh, chosen).evaluate(places).position),
            0);
  // What was chosen stays.
  EXPECT_EQ(distance(catmark, refine(mesh, {"catmull-clark", {{"triangles", "catmark"}}}, 2).positions), 0);

  Mesh open = jittered(grid(3, 3));
  const Points sharp = limit(open, "catmull-clark").points;
  open.boundary = Boundary::edge_only;
  EXPECT_GT(distance(sharp, limit(open, "catmull-clark").points), 1e-3) << "corners are round";
}

TEST(Verbs, SurfacesOwnWhatTheyNeed) {
  const Mesh mesh = jittered(cube());
  const std::vector<Place> places{{0, 0.25, 0.5}, {5, 0, 0}, {3, 1, 1}};
  LimitSurface surface = [&] { return LimitSurface(Mesh(mesh), AnyScheme("catmull-clark")); }();
  const Points before = surface.evaluate(places).position;
  Mesh other = mesh;
  other.positions *= 2;
  const LimitSurface pose = surface.with(other.positions);
  EXPECT_LE(distance(pose.evaluate(places).position, 2 * before), rounding);
  EXPECT_EQ(distance(pose.evaluate(places).position, LimitSurface(other, "catmull-clark").evaluate(places).position),
            0);
  const LimitSurface moved = std::move(surface);
  EXPECT_EQ(distance(surface.evaluate(places).position, before), 0) << "what is moved stays as it is";  // NOLINT
  EXPECT_EQ(distance(moved.evaluate(places).position, before), 0);
  // Rays and nearest points of a surface that goes.
  const RayTracer tracer = [&] { return RayTracer(LimitSurface(mesh, "catmull-clark")); }();
  EXPECT_EQ(tracer.trace({.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}}, {.all = true}).size(), 2);
  EXPECT_EQ(intersect(moved, {{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}}}, {.all = true}).t.size(), 2);
  Points query(1, 3);
  query << 3, 0, 0;
  EXPECT_NEAR(closest(moved, query).distances[0], (closest(moved, query).points.row(0) - query.row(0)).norm(), solved);
}

TEST(Verbs, TablesAreAppliedInEitherPrecisionAndInParts) {
  const TemporaryDirectory directory;
  const Mesh mesh = jittered(cube());
  for (const bool in_double : {false, true}) {
    const Table baked =
        bake(mesh, "catmull-clark", {.levels = 3, .limit = true, .derivatives = 1, .in_double = in_double});
    baked.save(directory / "table.safetensors");
    const Table table = load(directory / "table.safetensors");
    EXPECT_EQ(table.is_double(), in_double);
    EXPECT_EQ(table.quantities(), 3);
    std::vector<double> points(mesh.positions.data(), mesh.positions.data() + mesh.positions.size());
    std::vector<float> in_float(points.begin(), points.end());
    std::vector<double> of_double(table.num_results(3)), parts_of_double(of_double.size());
    std::vector<float> of_float(of_double.size()), parts_of_float(of_double.size());
    table.apply(points, 3, of_double);
    table.apply(in_float, 3, of_float);
    for (size_t i = 0; i < of_double.size(); ++i) EXPECT_NEAR(of_double[i], of_float[i], single_precision);
    const auto in_parts = [&]<class Real>(const std::vector<Real>& from, const std::vector<Real>& whole,
                                          std::vector<Real>& made) {
      const TableFrame<Real> frame(table, from, 3, made);
      for (int part = 6; part >= 0; --part) frame.apply_part(part, 7);
      frame.finish();
      EXPECT_EQ(made, whole) << "not the same bits";
    };
    if (in_double) {
      in_parts(points, of_double, parts_of_double);
      expect_error<InvalidParameter>([&] { TableFrame<float>(table, in_float, 3, parts_of_float); },
                                     {"double, not float"});
    } else {
      in_parts(in_float, of_float, parts_of_float);
    }
    // <T x, y> = <x, T' y>
    std::vector<double> back(points.size());
    table.apply_transpose(of_double, 3, back);
    double left = 0, right = 0;
    for (const double x : of_double) left += x * x;
    for (size_t i = 0; i < back.size(); ++i) right += back[i] * points[i];
    EXPECT_NEAR(left, right, (in_double ? solved : single_precision) * left);
    EXPECT_EQ(std::int64_t(table.faces().sizes.size()), 6 * 64);
  }
}

TEST(Verbs, TakeArraysOfManyKinds) {
  const Mesh mesh = cube();
  std::vector<std::array<float, 3>> floats;
  std::vector<Eigen::Vector3d> vectors;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const auto x = mesh.positions.row(v);
    floats.push_back({float(x[0]), float(x[1]), float(x[2])});
    vectors.emplace_back(x);
  }
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<std::vector<int>> lists;
  Eigen::MatrixXi F(6, 4);
  for (Index f = 0; f < 6; ++f) {
    quads.emplace_back();
    lists.emplace_back();
    for (Index c = 0; c < 4; ++c) {
      const Index v = mesh.face_vertices[size_t(4 * f + c)];
      quads.back()[size_t(c)] = std::uint32_t(v);
      lists.back().push_back(v);
      F(f, c) = v;
    }
  }
  const Eigen::MatrixXf V = mesh.positions.cast<float>();
  for (const Mesh& made :
       {sublimit::make_mesh(floats, quads), sublimit::make_mesh(vectors, lists), sublimit::make_mesh(V, F),
        sublimit::make_mesh(mesh.positions, {4, 4, 4, 4, 4, 4}, mesh.face_vertices)}) {
    EXPECT_EQ(made.face_vertices, mesh.face_vertices);
    EXPECT_EQ(made.face_sizes, mesh.face_sizes);
    EXPECT_EQ(distance(made.positions, mesh.positions), 0);
  }
}

TEST(Verbs, TextureCoordinatesComeAlong) {
  Mesh mesh = cube();
  Mesh::FaceVarying uv{"uv", Points(4, 2), {}};
  uv.values << 0, 0, 1, 0, 1, 1, 0, 1;
  for (Index f = 0; f < 6; ++f) uv.indices.insert(uv.indices.end(), {0, 1, 2, 3});
  mesh.face_varying = {uv};
  const Mesh fine = refine(mesh, "catmull-clark", 2);
  ASSERT_EQ(fine.face_varying.size(), 1);
  EXPECT_EQ(fine.face_varying[0].indices.size(), fine.face_vertices.size());
  EXPECT_TRUE(fine.warnings.empty());
}

TEST(Verbs, FitsMeetTheirTargets) {
  const Mesh mesh = cube();
  const Fit fit = sublimit::fit(mesh, "catmull-clark",
                                {{.vertex = 0, .position = {-1, -1, -1}},
                                 {.vertex = 7, .position = {1, 1, 1}, .normal = Eigen::Vector3d(0, 0, 1)}});
  ASSERT_TRUE(fit.solved) << fit.why_not;
  const Limit limit = sublimit::limit(fit.mesh, "catmull-clark");
  EXPECT_LE((limit.points.row(7) - Eigen::RowVector3d(1, 1, 1)).norm(), solved);
  EXPECT_LE(fit.position_error.maxCoeff(), solved);

  const LimitSurface surface(mesh, "catmull-clark");
  const std::vector<Place> places = surface.grid(4);
  const ScatteredFit scattered =
      fit_places(surface, {.places = places, .values = 2 * surface.evaluate(places).position});
  EXPECT_LE(distance(scattered.points, 2 * mesh.positions), least_squares);
  const CloudFit cloud = fit_cloud(surface, {.points = surface.evaluate(places).position});
  EXPECT_LE(cloud.foot_points.distances.cwiseAbs().maxCoeff(), least_squares);
}

TEST(Verbs, ReportsAreTextAndPages) {
  const TemporaryDirectory directory;
  const Report report = analyze("catmull-clark", {.valences = {3}});
  EXPECT_NE(report.json().find("\"kind\": \"schemes\""), std::string::npos) << report.json().substr(0, 300);
  report.save_html(directory / "report.html");
  report.save_json(directory / "report.json");
  EXPECT_EQ(directory.num_files(), 2);
  const Report of_mesh = analyze(cube(), "catmull-clark", {.tolerance = {"g1=0.1deg"}, .name = "box"});
  EXPECT_NE(of_mesh.json().find("\"box\""), std::string::npos);
}

TEST(Verbs, InfoSaysWhatThereIs) {
  const MeshInfo plain = info(cube());
  EXPECT_EQ(plain.euler_characteristic, 2);
  EXPECT_TRUE(plain.scheme.empty());
  const MeshInfo of_scheme = info(cube(), "loop");
  EXPECT_EQ(of_scheme.scheme, "loop");
  EXPECT_NE(of_scheme.why_not, "");
}

// Bad input throws an error that names it, and makes nothing.

TEST(Verbs, RefuseWhatIsWrong) {
  const Mesh good = cube();
  expect_error<InvalidOption>([&] { (void)AnyScheme("catmul-clark"); }, {"catmull-clark"});
  expect_error<InvalidOption>([&] { (void)AnyScheme("kobbelt", {{"tenson", "1"}}); }, {"tension"});
  expect_error<InvalidParameter>([&] { (void)refine(good, "catmull-clark", -1); }, {"-1"});
  expect_error<InvalidParameter>([&] { (void)limit(good, "catmull-clark", {.levels = -1}); }, {"-1"});
  Mesh broken = good;
  broken.face_vertices[5] = 8;
  for (const auto& use : std::vector<std::function<void()>>{
           [&] { (void)refine(broken, "catmull-clark", 1); }, [&] { (void)levels(broken, "catmull-clark", 1); },
           [&] { (void)limit(broken, "catmull-clark"); }, [&] { (void)LimitSurface(broken, "catmull-clark"); },
           [&] { (void)bake(broken, "catmull-clark", {.levels = 1}); }, [&] { (void)info(broken); },
           [&] { (void)fit(broken, "catmull-clark", {}); }, [&] { (void)analyze(broken, "catmull-clark"); }})
    expect_error<InvalidMesh>([&] { use(); }, {"8"});
  expect_error<UnsupportedTopology>([&] { (void)refine(good, "loop", 1); }, {"4"});
  const auto other = std::make_shared<LimitCache>(find_scheme("bilinear").value());
  expect_error<InvalidParameter>([&] { (void)limit(good, "catmull-clark", {.cache = other}); }, {"bilinear"});
  expect_error<InvalidParameter>([&] { (void)LimitSurface(good, "catmull-clark", other); }, {"bilinear"});
  expect_error<InvalidParameter>([&] { (void)bake(good, "catmull-clark", {}); }, {"one of levels, grid and at"});
  expect_error<InvalidParameter>([&] { (void)bake(good, "catmull-clark", {.levels = 1, .grid = 3}); }, {"2 of them"});
  expect_error<InvalidParameter>([&] { (void)bake(good, "catmull-clark", {.limit = true, .grid = 3}); },
                                 {"limit is of levels"});
  const LimitSurface surface(good, "catmull-clark");
  expect_error<InvalidParameter>([&] { (void)surface.with(Points::Zero(7, 3)); }, {"7 x 3"});
  expect_error<InvalidParameter>([&] { (void)surface.evaluate(surface.grid(2), 3); }, {"3"});
  EXPECT_EQ(surface.evaluate({{.face = 6, .u = 0, .v = 0}}).status[0], LimitStatus::outside);
  expect_error<InvalidParameter>([&] { (void)surface.stencils(std::vector<Place>{{6, 0, 0}}); }, {"6"});
  expect_error<InvalidParameter>([&] { (void)curvature(surface.evaluate(surface.grid(2), 2), 24); }, {"24 of 24"});
  expect_error<ResourceError>([&] { (void)surface.grid(1'000'000); }, {"1000000 samples"});
  const Table table = bake(good, "catmull-clark", {.levels = 1});
  std::vector<float> points(24), result(table.num_results(3));
  expect_error<InvalidParameter>([&] { table.apply(points, 2, result); }, {"52 are right"});
  expect_error<InvalidParameter>([&] { table.apply(std::span(points).first(23), 3, result); },
                                 {"23 numbers; 24 are right"});
  expect_error<InvalidParameter>([&] { table.apply(points, 0, result); }, {"channels are 0"});
  Scheme<double> own = find_scheme("catmull-clark").value();
  own.source = "mine";
  expect_error<InvalidOption>([&] { (void)analyze(own); }, {"exact"});
}

TEST(Verbs, OfEmptyMeshesAreEmpty) {
  for (const Mesh& empty : {Mesh{}, sublimit::make_mesh(Points(0, 3), {}, {})}) {
    EXPECT_EQ(refine(empty, "catmull-clark", 2).num_vertices(), 0);
    EXPECT_EQ(limit(empty, "catmull-clark").points.rows(), 0);
    EXPECT_EQ(LimitSurface(empty, "catmull-clark").faces().size, 0);
    EXPECT_EQ(info(empty).faces, 0);
  }
}

TEST(Verbs, RefuseNumbersThatAreNone) {
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = cube();
    mesh.positions(3, 1) = x;
    const LimitSurface surface(cube(), "catmull-clark");
    for (const auto& use : std::vector<std::function<void()>>{
             [&] { (void)refine(mesh, "catmull-clark", 1); }, [&] { (void)limit(mesh, "catmull-clark"); },
             [&] { (void)LimitSurface(mesh, "catmull-clark"); }, [&] { (void)surface.with(mesh.positions); }})
      expect_error<InvalidMesh>(use, {"control point 3", "not finite"});
  }
  Mesh flat = cube();
  flat.positions.conservativeResize(8, 2);
  expect_error<InvalidMesh>([&] { (void)refine(flat, "catmull-clark", 1); }, {"2 coordinates"});
  expect_error<InvalidMesh>([&] { (void)limit(flat, "catmull-clark"); }, {"2 coordinates"});
  const std::vector<std::vector<double>> ragged{{0, 0, 0}, {1, 0}, {0, 1, 0}};
  const std::vector<std::array<int, 3>> faces{{0, 1, 2}};
  expect_error<InvalidMesh>([&] { (void)sublimit::make_mesh(ragged, faces); }, {"point 1", "2 coordinates"});
  const Eigen::MatrixXd two = Eigen::MatrixXd::Zero(3, 2);
  const Eigen::MatrixXi F = Eigen::RowVector3i(0, 1, 2);
  expect_error<InvalidMesh>([&] { (void)sublimit::make_mesh(two, F); }, {"2 coordinates"});
}

TEST(Verbs, WhatIsMovedStaysAsItIs) {
  const Mesh mesh = cube();
  AnyScheme scheme("catmull-clark");
  const AnyScheme moved_scheme = std::move(scheme);
  EXPECT_EQ(refine(mesh, scheme, 1).num_vertices(), refine(mesh, moved_scheme, 1).num_vertices());  // NOLINT
  Table table = bake(mesh, "catmull-clark", {.levels = 1});
  const Table moved = std::move(table);
  EXPECT_EQ(table.num_points(), moved.num_points());  // NOLINT
  RayTracer tracer(LimitSurface(mesh, "catmull-clark"));
  const RayTracer moved_tracer = std::move(tracer);
  const Ray ray{.origin = {0.1, 0.2, -5}, .direction = {0, 0, 1}};
  EXPECT_EQ(tracer.trace(ray).size(), moved_tracer.trace(ray).size());  // NOLINT
}

template <class T>
Scheme<T> mine(int weight) {
  return {
      .name = "mine",
      .source = "here",
      .steps = {Step<T>{
          .split = Split::pqq,
          .masks = {
              .vertex = [weight](const Ring<T>& v) { return (weight * v.center() + v.neighbor_mean()) / (weight + 1); },
              .edge = [](const EdgeSite<T>& e) { return (e.tail() + e.head()) / 2; },
              .face = [](const FaceSite<T>& f) { return f.centroid(); }}}},
      .creases = cubic_bspline_creases<T>()};
}

TEST(Verbs, WhatTemporariesReturnLives) {
  const std::string& json = analyze("loop", {.valences = {3}}).json();
  const Points& points = LimitSurface(cube(), "catmull-clark").points();
  const Scheme<double>& scheme = *AnyScheme("loop");
  const TableInfo& info = bake(cube(), "catmull-clark", {.levels = 1}).info();
  EXPECT_EQ(json.front(), '{');
  EXPECT_EQ(points, cube().positions);
  EXPECT_EQ(scheme.name, "loop");
  EXPECT_EQ(info.scheme, "catmull-clark");
}

TEST(Verbs, ReportsNeedTheSameMasksInBothNumbers) {
  EXPECT_NE(analyze(mine<double>(1), mine<Algebraic>(1), {.valences = {4, 3, 4}}).json(), "");
  expect_error<InvalidParameter>([&] { (void)analyze(mine<double>(1), mine<Algebraic>(2), {.valences = {3}}); },
                                 {"mine", "exact numbers", "same masks"});
  expect_error<InvalidParameter>([&] { (void)analyze(mine<double>(1), Scheme<Algebraic>{}, {.valences = {3}}); },
                                 {"steps"});
  expect_error<InvalidParameter>([&] { (void)analyze("loop", {.valences = {}}); }, {"valences"});
  expect_error<FormatError>([&] { Report("nothing").save_html("report.html"); }, {"no report"});
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/asset_report.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/report/asset/asset_json.h"
#include "sublimit/report/asset/curvature_statistics.h"
#include "sublimit/report/asset/surface_places.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;
/// Normals on both sides of a seam, degrees: cross products of sums of hundreds of terms.
constexpr double same_normal = 1e-9;
/// Second derivatives near extraordinary points, relative: their own rounding grows with the depth.
constexpr double same_curvature = 1e-8;
/// Places on both sides of a seam: sums of hundreds of terms of size 1, and the places themselves 2^-50 apart.
constexpr double same_place = 1e-13;
/// Places at thirds are rounded ones: positions, and normals in degrees, which turn within that.
constexpr double at_thirds = 1e-11, turned_at_thirds = 1e-6;
/// Angles between plane faces, in degrees, and where on an edge they are.
constexpr double in_degrees = 1e-9, on_the_edge = 1e-12;
/// Sums over thousands of samples of what is exactly known: area, total curvature.
constexpr double of_integrals = 1e-9;
/// The same mesh in another unit, which rounds anew.
constexpr double of_another_unit = 1e-9;
/// A norm of sums of a few products.
constexpr double of_bending = 1e-13;
/// Half of the last of the decimals that a ratio is given with.
constexpr double of_four_decimals = 5e-5, of_three_decimals = 5e-4;

/// Cells of 1/16 and 1/32 of a face on the meshes here.
constexpr std::int64_t curvature_samples = 20'000;

AssetReport report(const std::string& scheme, const Mesh& mesh, AssetOptions options = {}) {
  options.curvature_samples = std::min<std::int64_t>(options.curvature_samples, curvature_samples);
  options.surface_faces = std::min(options.surface_faces, 500);
  return asset_report(find_scheme(scheme).value(), mesh, {}, options);
}

/// Where what is not asked of statistics and pictures would take the time.
const AssetOptions few = {.curvature_samples = 500, .surface_faces = 20};

/// Of the midpoint rule extrapolated from cells twice as large, as a part of what those changed. The rule's error falls
/// by 4 (by 3.3 to 4 where curvature is unbounded: some points' share falls like (mu/lambda)^2, more slowly than area).
constexpr double extrapolated = .1;

/// Gauss, Bonnet: closed surfaces that are C^1, and C^2 but for points, bend by 2 pi chi in all.
void expect_gauss_bonnet(const AssetReport& r, const Mesh& mesh, int characteristic, bool dual = false) {
  const LimitMap surface(find_scheme(r.scheme).value(), mesh);
  const LimitSurface bound(surface, mesh.positions);
  const AssetCurvature coarse = asset::curvature_statistics(surface, bound, curvature_samples / 4, {.dual = dual}, {});
  ASSERT_EQ(4 * coarse.samples, r.curvature.samples);
  const double change = r.curvature.total_gauss.value() - coarse.total_gauss.value();
  EXPECT_NEAR(r.curvature.total_gauss.value() + change / 3, 2 * pi * characteristic, extrapolated * std::abs(change));
  EXPECT_LE(std::abs(change), .08) << "the rule is far from its limit";
}

const AssetKind* find_kind(const AssetReport& r, const std::string& kind, Index n) {
  for (const AssetKind& k : r.inventory)
    if (k.kind == kind && k.n == n) return &k;
  return nullptr;
}

const AssetWarning* find_warning(const AssetReport& r, const std::string& text) {
  for (const AssetWarning& w : r.warnings)
    if (w.says.find(text) != std::string::npos) return &w;
  return nullptr;
}

TEST(AssetReport, CubeIsSmoothAcrossAllSeamsAndFlatAtItsCorners) {
  const AssetReport r = report("catmull-clark", cube());
  EXPECT_EQ(r.seams.edges, 12);
  EXPECT_LT(r.seams.inside.g0.value(), same_place);
  EXPECT_LT(r.seams.inside.g1_degrees.value(), same_normal);
  EXPECT_LT(r.seams.inside.g2.value(), same_curvature);
  EXPECT_GT(r.seams.inside.compared, 400);
  EXPECT_FALSE(r.seams.across_creases.g1_degrees);
  // Curvature differs around the corners: it tends to zero like 0.991^k, and not evenly.
  EXPECT_GT(r.seams.around_points.g2.value(), 0.01);

  const AssetKind* corner = find_kind(r, "extraordinary vertex", 3);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->count, 8);
  EXPECT_EQ(corner->verdict->plane, PlaneVerdict::yes);
  EXPECT_EQ(corner->verdict->curvature, CurvatureVerdict::flat);
  EXPECT_NEAR(corner->verdict->ratio.value(), 0.9910, of_four_decimals);
  EXPECT_EQ(r.curvature.unbounded_at, 0);
  expect_gauss_bonnet(r, cube(), 2);
  EXPECT_LT(r.curvature.mean->max, 0) << "a convex surface bends away from its normal";
}

TEST(AssetReport, BilinearShowsTheAnglesOfTheMesh) {
  AssetOptions options;
  read_tolerance("g1=1deg", options.tolerance);
  const AssetReport r = report("bilinear", cube(), options);
  EXPECT_NEAR(r.seams.inside.g1_degrees.value(), 90, in_degrees);
  EXPECT_LT(r.seams.inside.g0.value(), same_place);
  EXPECT_EQ(r.seams.within_tolerance, false);
  ASSERT_FALSE(r.seams.beyond.empty());
  EXPECT_STREQ(r.seams.beyond[0].what, "g1");
  EXPECT_NEAR(r.seams.beyond[0].place.cwiseAbs().maxCoeff(), 1, on_the_edge);
  EXPECT_NEAR(r.curvature.area, 24, of_integrals);
  EXPECT_NEAR(r.curvature.total_gauss.value(), 0, of_integrals);
}

/// Two plane wings of 2 x 3 squares that meet in a ridge at an angle between their normals.
Mesh roof(double degrees) {
  Mesh mesh;
  mesh.positions.resize(20, 3);
  const double a = degrees * pi / 360;
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 5; ++i) {
      const double s = i - 2;
      mesh.positions.row(j * 5 + i) << s * std::cos(a), j, -std::abs(s) * std::sin(a);
    }
  for (Index j = 0; j < 3; ++j)
    for (Index i = 0; i < 4; ++i) {
      const Index v = j * 5 + i;
      mesh.face_sizes.push_back(4);
      mesh.face_vertices.insert(mesh.face_vertices.end(), {v, v + 1, v + 6, v + 5});
    }
  return mesh;
}

TEST(AssetReport, CreaseShowsItsAngleAndIsNotJudged) {
  Mesh mesh = roof(50);
  add_crease(mesh, {2, 7, 12, 17}, infinite_sharpness);
  AssetOptions options;
  read_tolerance("g1=0.1deg", options.tolerance);
  const AssetReport r = report("catmull-clark", mesh, options);
  EXPECT_EQ(r.seams.crease_edges, 3);
  EXPECT_EQ(r.seams.border_edges, 14);
  EXPECT_NEAR(r.seams.across_creases.g1_degrees.value(), 50, in_degrees);
  EXPECT_LT(r.seams.across_creases.g0.value(), same_place);
  EXPECT_LT(r.seams.inside.g1_degrees.value(), same_normal);
  EXPECT_EQ(r.seams.within_tolerance, true);
  const AssetKind* crease = find_kind(r, "crease vertex", 4);
  ASSERT_TRUE(crease);
  EXPECT_EQ(crease->count, 2);
  EXPECT_EQ(crease->sides, (std::vector<Index>{2, 2}));
  const AssetWarning* end = find_warning(r, "crease that ends at the border");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->vertices, (std::vector<Index>{2, 17}));

  // Half as sharp, the ridge is round, and the crease is told from what stays sharp.
  add_crease(mesh, {2, 7, 12, 17}, 5.f);
  const AssetReport round = report("catmull-clark", mesh, options);
  EXPECT_EQ(round.seams.crease_edges, 0);
  EXPECT_LT(round.seams.inside.g1_degrees.value(), same_normal);
  EXPECT_TRUE(find_warning(round, "sharpness beyond the 4 levels"));
  EXPECT_FALSE(find_warning(round, "crease that ends"));
}

TEST(AssetReport, WarnsOfBorderVerticesWithTooManyFaces) {
  const auto plane = [](const std::string& scheme, Index n, Index size) {
    const AssetReport r = report(scheme, open_fan(n, size));
    const AssetKind* kind = find_kind(r, "border vertex", n);
    return kind ? kind->verdict->plane : PlaneVerdict::unknown;
  };
  EXPECT_EQ(plane("catmull-clark", 3, 4), PlaneVerdict::yes);
  EXPECT_EQ(plane("catmull-clark", 4, 4), PlaneVerdict::slow);
  EXPECT_EQ(plane("catmull-clark", 5, 4), PlaneVerdict::no);
  EXPECT_EQ(plane("loop", 5, 3), PlaneVerdict::yes);
  EXPECT_EQ(plane("loop", 6, 3), PlaneVerdict::slow);
  EXPECT_EQ(plane("loop", 7, 3), PlaneVerdict::no);

  AssetOptions options;
  read_tolerance("g1=0.1deg", options.tolerance);
  const AssetReport r = report("catmull-clark", open_fan(6), options);
  const AssetWarning* warning = find_warning(r, "no tangent plane");
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->severity, AssetWarning::Severity::error);
  EXPECT_EQ(warning->vertices, std::vector<Index>{0});
  EXPECT_EQ(warning->place.value(), Eigen::Vector3d(open_fan(6).positions.row(0)));
  EXPECT_FALSE(warning->advice.empty());
  // And the normals around it are measured: they would not come closer however near.
  EXPECT_EQ(r.seams.within_tolerance, false);
  EXPECT_EQ(r.seams.beyond[0].at, SeamExcess::At::point);
}

TEST(AssetReport, FindsTheCurvatureOfATorus) {
  // Points on circles of m and n points give limits on circles of (2 + cos(2 pi/m))/3 and so for n, to the second order
  // in the distance of the points.
  const Index m = 48, n = 32;
  const AssetReport r = report("catmull-clark", torus(m, n));
  const double am = (2 + std::cos(2 * pi / m)) / 3, an = (2 + std::cos(2 * pi / n)) / 3;
  const double R = 2 * am, ra = am * an, rz = an;  // the tube is an ellipse, nearly round
  const double tolerance = 0.02;
  EXPECT_NEAR(r.curvature.gauss->max, ra / (rz * rz) / (R + ra), tolerance);
  EXPECT_NEAR(r.curvature.gauss->min, -ra / (rz * rz) / (R - ra), tolerance);
  EXPECT_NEAR(r.curvature.total_gauss.value(), 0, of_integrals);
  EXPECT_NEAR(r.curvature.area / (4 * pi * pi * R * rz), 1, tolerance);
  // H = -(1/r + cos/(R + r cos))/2 with outward normals.
  EXPECT_NEAR(r.curvature.mean->max, -.5 * (1 / rz - 1 / (R - ra)), tolerance);
  EXPECT_NEAR(r.curvature.mean->min, -.5 * (1 / rz + 1 / (R + ra)), tolerance);
  EXPECT_NEAR(Eigen::Vector2d(r.curvature.worst[0].place.head<2>()).norm(), R + ra, tolerance);
  EXPECT_LE(r.curvature.gauss->quantiles[0], r.curvature.gauss->quantiles[6]);
  EXPECT_EQ(r.curvature.without, 0);
  ASSERT_FALSE(r.surface.curvature.empty());
  for (const auto& c : r.surface.curvature) ASSERT_TRUE(c);
}

TEST(AssetReport, KnowsWhatEachSchemeDoesAtSeams) {
  // Biquadratic patches: normals agree, curvatures do not.
  const AssetReport quadratic = report("doo-sabin", jittered(torus(5, 4), 0.2));
  EXPECT_LT(quadratic.seams.inside.g1_degrees.value(), same_normal);
  EXPECT_GT(quadratic.seams.inside.g2.value(), 0.01);
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.claims.regular == 0) continue;
    SCOPED_TRACE(scheme.name);
    const AssetReport r = report(scheme.name, scheme.face_size() == 3 ? jittered(octahedron()) : jittered(cube()), few);
    EXPECT_LT(r.seams.inside.g0.value(), at_thirds);
    EXPECT_LT(r.seams.inside.g1_degrees.value_or(0), turned_at_thirds);
    EXPECT_GT(r.seams.inside.compared, 0);
    EXPECT_GT(r.curvature.area, 0);
  }
}

TEST(AssetReport, FindsNoFaultWithPlainSheets) {
  for (const Scheme<double>& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name);
    const AssetReport r = report(scheme.name, scheme.face_size() == 3 ? triangle_grid(3, 3) : grid(3, 3), few);
    EXPECT_LT(r.seams.inside.g0.value(), at_thirds);
    for (const AssetWarning& w : r.warnings)
      if (scheme.claims.regular > 0) ADD_FAILURE() << w.says;
    EXPECT_EQ(r.seams.border_edges, 12);
  }
  // A vertex among two faces, which mid-edge glues.
  EXPECT_LT(report("mid-edge", jittered(disjoint_union(fan(2, 4, 2), cube())), few).seams.inside.g0.value(), at_thirds);
}

TEST(AssetReport, KnowsExtraordinaryFacesAndTriangles) {
  // Doo, Sabin: mu = lambda^2 at every n, in a Jordan block from n = 5 on.
  const AssetReport dual = report("doo-sabin", jittered(prism(5)));
  ASSERT_TRUE(find_kind(dual, "extraordinary face", 5));
  EXPECT_EQ(find_kind(dual, "extraordinary face", 5)->verdict->curvature, CurvatureVerdict::logarithmic);
  EXPECT_EQ(find_kind(dual, "extraordinary vertex", 3)->verdict->curvature, CurvatureVerdict::bounded);
  expect_gauss_bonnet(dual, jittered(prism(5)), 2, true);
  EXPECT_EQ(dual.curvature.unbounded_at, 2);
  ASSERT_FALSE(dual.surface.curvature.empty());
  for (const auto& c : dual.surface.curvature) ASSERT_TRUE(c) << "beside seams and extraordinary points there is one";
  // Pentagons of a primal scheme, on both halves of whose edges squares end.
  const AssetReport primal = report("catmull-clark", jittered(prism(5)));
  EXPECT_LT(primal.seams.inside.g0.value(), same_place);
  EXPECT_LT(primal.seams.inside.g2.value(), same_curvature);
  EXPECT_NEAR(find_kind(primal, "extraordinary face", 5)->verdict->ratio.value(), 1.124, of_three_decimals);
  expect_gauss_bonnet(primal, jittered(prism(5)), 2);
  // Loop: the second eigenvalue of block 0 is the square of lambda.
  const AssetReport loop = report("loop", jittered(icosahedron()));
  EXPECT_EQ(find_kind(loop, "extraordinary vertex", 5)->verdict->curvature, CurvatureVerdict::bounded);
  EXPECT_LT(loop.seams.inside.g2.value(), same_curvature);
  expect_gauss_bonnet(loop, jittered(icosahedron()), 2);
}

TEST(AssetReport, DoesNotDependOnTheUnit) {
  Mesh mesh = torus(8, 8);
  mesh.positions *= 1000;  // what is relative stays
  const AssetReport large = report("catmull-clark", mesh), small = report("catmull-clark", torus(8, 8));
  EXPECT_NEAR(large.curvature.gauss->max * 1e6, small.curvature.gauss->max, of_another_unit);
  EXPECT_NEAR(large.curvature.mean->min * 1e3, small.curvature.mean->min, of_another_unit);
  EXPECT_LT(large.seams.inside.g2.value(), same_curvature);
  // Curvature that jumps does so by the same part.
  Mesh wavy = jittered(torus(5, 4), 0.2);
  const double jump = report("doo-sabin", wavy).seams.inside.g2.value();
  wavy.positions *= 1000;
  EXPECT_NEAR(report("doo-sabin", wavy).seams.inside.g2.value(), jump, of_another_unit);
  EXPECT_LE(jump, 2) << "a part of the larger one";
}

TEST(AssetReport, ComparesCurvatureInEveryDirection) {
  // z = (a x^2 + b y^2)/2 at its vertex, turned anyhow: the tensor's norm is that of (a, b).
  for (const double angle : {0., .4, 1.1, 2.5}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    LimitSamples s;
    const auto row = [&](double x, double y, double z) {
      return Points((turn * Eigen::Vector3d(x, y, z)).transpose());
    };
    s.du = row(1, 0, 0);
    s.dv = row(1, 1, 0);  // parameters need not be square
    s.duu = row(0, 0, 3);
    s.duv = row(0, 0, 3);
    s.dvv = row(0, 0, 3 - 4);
    s.order = {2};
    const std::optional<asset::Bending> b = asset::bending(s, 0);
    ASSERT_TRUE(b);
    EXPECT_NEAR(b->norm(), 5, of_bending);
    EXPECT_NEAR((*b)[0] + (*b)[1] + (*b)[2], 3 - 4, of_bending) << "the trace is twice the mean curvature";
  }
}

TEST(AssetReport, WarnsOfWhatAModellerCanChange) {
  const AssetReport poles = report("catmull-clark", pole(9));
  const AssetWarning* high = find_warning(poles, "high valence, 9: curvature diverges");
  ASSERT_TRUE(high);
  EXPECT_EQ(high->count, 2);
  EXPECT_EQ(poles.curvature.unbounded_at, 2);

  Mesh mesh = grid(4, 4);
  add_crease(mesh, {6, 7, 8}, infinite_sharpness);
  mesh.positions.row(24) = mesh.positions.row(19);  // of the last face two corners coincide,
  mesh.positions.row(23) = mesh.positions.row(18);  // in pairs
  mesh.positions.conservativeResize(26, Eigen::NoChange);
  mesh.positions.row(25).setZero();
  const AssetReport r = report("catmull-clark", mesh);
  const AssetWarning* dart = find_warning(r, "(a dart)");
  ASSERT_TRUE(dart);
  EXPECT_EQ(dart->vertices, (std::vector<Index>{6, 8}));
  const AssetWarning* isolated = find_warning(r, "no face uses");
  ASSERT_TRUE(isolated);
  EXPECT_EQ(isolated->vertices, std::vector<Index>{25});
  const AssetWarning* empty = find_warning(r, "without area");
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->faces, std::vector<Index>{15});
  EXPECT_TRUE(find_kind(r, "isolated vertex", 0));
  EXPECT_TRUE(std::is_sorted(r.warnings.begin(), r.warnings.end(),
                             [](const AssetWarning& a, const AssetWarning& b) { return a.severity < b.severity; }));
}

TEST(AssetReport, LeavesHolesOut) {
  Mesh mesh = cube();
  mesh.holes = {2};
  const AssetReport whole = report("catmull-clark", cube()), r = report("catmull-clark", mesh);
  EXPECT_NEAR(r.curvature.area / whole.curvature.area, 5. / 6, of_integrals);
  EXPECT_EQ(r.surface.face_sizes.size() * 6, whole.surface.face_sizes.size() * 5);
  ASSERT_TRUE(find_kind(r, "hole", 0));
  EXPECT_EQ(find_kind(r, "hole", 0)->examples, std::vector<Index>{2});
}

TEST(AssetReport, RefusesWhatTheSchemeCannotTakeAndBadOptions) {
  expect_error<UnsupportedTopology>([] { report("loop", cube()); }, {"face 0 has 4 corners", "triangles"});
  expect_error<InvalidOption>(
      [] {
        AssetOptions options;
        options.levels = 0;
        report("loop", octahedron(), options);
      },
      {"1 or more"});
}

TEST(AssetReport, IsTheSameForAnyNumberOfThreadsAndTellsProgress) {
  const Mesh mesh = quads_from_triangles(jittered(triangle_torus(12, 10)));
  AssetOptions options;
  read_tolerance("g2=1e-12", options.tolerance);
  int last = 0, calls = 0;
  const std::string many = to_json(report("catmull-clark", mesh, options), "x.obj").dump();
  std::string one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = to_json(asset_report(
                      find_scheme("catmull-clark").value(), mesh, {},
                      {.tolerance = options.tolerance, .curvature_samples = curvature_samples, .surface_faces = 500},
                      [&](int done, int all) {
                        EXPECT_GE(done, last);
                        EXPECT_LE(done, all);
                        last = done;
                        ++calls;
                      }),
                  "x.obj")
              .dump();
  }
  EXPECT_EQ(many, one);
  EXPECT_EQ(last, 1000);
  EXPECT_GT(calls, 4);
}

TEST(AssetJson, HasTheFormatsKeysAndNoNaN) {
  AssetOptions options;
  read_tolerance("g0=1%", options.tolerance);
  const nlohmann::ordered_json j = to_json(report("catmull-clark", open_fan(6), options), "fan.obj");
  std::string keys;
  for (const auto& [key, value] : j.items()) keys += key + " ";
  EXPECT_EQ(keys, "file scheme counts box inventory seams curvature surface worst warnings ");
  EXPECT_EQ(j["counts"]["faces"], 6);
  const Mesh fan = open_fan(6);
  EXPECT_DOUBLE_EQ(j["seams"]["tolerance"]["g0"], 0.01 * diagonal(fan.positions));
  EXPECT_TRUE(j["seams"]["tolerance"]["g2"].is_null());
  EXPECT_TRUE(j["seams"]["across_creases"]["g1_degrees"].is_null());
  EXPECT_EQ(j["warnings"][0]["where"], "vertex 0 (1-based 1)");
  EXPECT_EQ(j["surface"]["positions"].size(), j["surface"]["curvature"].size());
  EXPECT_EQ(j["inventory"][0]["by"], "floating");
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Area, volume and moments of the limit.
#include "sublimit/integrals/limit_integrals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "laws/tested_schemes.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Relative to the surface's own area, where it is halved until Gauss rules agree.
constexpr double area_tolerance = 1e-10;
/// Sums of some thousand terms, each exact but for the conditioning of Bernstein coefficients.
constexpr double moment_tolerance = 1e-13;

/// What levels of a million faces leave open, at least, where there are no polynomials.
constexpr double refined_tolerance = 1e-4;

LimitIntegrals integrals(const Scheme<double>& scheme, const Mesh& mesh) {
  return limit_integrals(LimitMap(scheme, mesh), mesh.positions);
}
LimitIntegrals integrals(const char* scheme, const Mesh& mesh) { return integrals(*find_scheme<double>(scheme), mesh); }

/// The same from the next level, or the one after of schemes that turn.
LimitIntegrals refined_integrals(const Scheme<double>& scheme, const Mesh& mesh) {
  std::vector<Level> levels = refine(scheme, mesh, scheme.period);
  const Points points = refinement_matrix(levels) * mesh.positions;
  return limit_integrals(LimitMap(scheme, std::move(levels.back())), points);
}

/// Signed volume of a mesh of quadrilaterals and triangles, each the cone over its fan of triangles.
double volume_of(const Topology& t, const Points& x) {
  double sum = 0;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto corners = t.vertices(Face{f});
    for (size_t i = 2; i < corners.size(); ++i) {
      const Eigen::Vector3d a = x.row(corners[0]), b = x.row(corners[i - 1]), c = x.row(corners[i]);
      sum += a.dot(b.cross(c)) / 6;
    }
  }
  return sum;
}

const std::vector<TestedScheme> with_polynomials{
    {"bilinear", {}},  {"catmull-clark", {}}, {"loop", {}},
    {"doo-sabin", {}}, {"mid-edge", {}},      {"averaging", {{"degree", "3"}}},
};

const std::vector<TestedScheme> without_polynomials{
    {"butterfly", {}}, {"sqrt3", {}}, {"interpolatory-sqrt3", {}}, {"kobbelt", {}}};

Mesh closed_mesh(const Scheme<double>& scheme) {
  return jittered(takes_triangles(scheme) ? octahedron() : cube(), 0.2);
}

/// Up to what both say of themselves, which is 0 for volumes of polynomials.
void expect_equal_areas(const LimitIntegrals& a, const LimitIntegrals& b, double size) {
  EXPECT_NEAR(a.area, b.area, std::max(area_tolerance * b.area, a.area_error + b.area_error));
  ASSERT_TRUE(a.centroid && b.centroid);
  EXPECT_LE((*a.centroid - *b.centroid).norm(), std::max(area_tolerance * size, a.centroid_error + b.centroid_error));
}

void expect_equal(const LimitIntegrals& a, const LimitIntegrals& b, double size) {
  expect_equal_areas(a, b, size);
  EXPECT_EQ(a.why_no_solid, b.why_no_solid);
  ASSERT_EQ(a.solid.has_value(), b.solid.has_value());
  if (!a.solid) return;
  const SolidIntegrals &s = *a.solid, &t = *b.solid;
  EXPECT_NEAR(s.volume, t.volume, moment_tolerance * std::pow(size, 3) + s.volume_error + t.volume_error);
  EXPECT_LE((s.centroid - t.centroid).norm(), 10 * moment_tolerance * size + s.centroid_error + t.centroid_error);
  EXPECT_LE((s.inertia - t.inertia).norm(),
            10 * moment_tolerance * std::pow(size, 5) + s.inertia_error + t.inertia_error);
}

TEST(LimitIntegrals, OfACubeAreThoseOfACube) {
  Mesh creased = cube();
  for (const auto& path : {std::vector<Index>{0, 1, 3, 2, 0}, {4, 5, 7, 6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}})
    add_crease(creased, path, 10);
  for (Index v = 0; v < 8; ++v) creased.corners.push_back({v, 10});
  const double diameter = 2 * std::sqrt(3.);
  for (const LimitIntegrals& found : {integrals("bilinear", cube()), integrals("catmull-clark", creased)}) {
    EXPECT_NEAR(found.area, 24, area_tolerance * 24);
    EXPECT_LE(found.centroid->norm(), moment_tolerance);
    ASSERT_TRUE(found.solid) << found.why_no_solid;
    EXPECT_NEAR(found.solid->volume, 8, moment_tolerance * 8);
    EXPECT_LE(found.solid->centroid.norm(), moment_tolerance * diameter);
    EXPECT_LE((found.solid->inertia - 16. / 3 * Eigen::Matrix3d::Identity()).norm(), moment_tolerance * 16);
  }
}

/// Two creased squares make a cylinder over a closed uniform cubic spline. Its area is the sum of products P_i x P_j,
/// weighted by derivatives of the B-spline of degree 7 at integers: (245, 56, 1) / 720 for j - i = 1, 2, 3. The square
/// of side 2 has products 2, 0, -2, so 4 (245 * 2 - 2) / 720.
TEST(LimitIntegrals, OfACylinderOverASplineAreThoseOfItsCurve) {
  Mesh mesh = cube();
  add_crease(mesh, {0, 1, 3, 2, 0}, 10);
  add_crease(mesh, {4, 5, 7, 6, 4}, 10);
  const LimitIntegrals found = integrals("catmull-clark", mesh);
  const double base = 4 * (245. * 2 - 2) / 720;
  ASSERT_TRUE(found.solid) << found.why_no_solid;
  EXPECT_NEAR(found.solid->volume, 2 * base, moment_tolerance * 8);
  EXPECT_NEAR(found.solid->inertia(0, 0) + found.solid->inertia(1, 1) - found.solid->inertia(2, 2), 2 * 2 * base / 3,
              moment_tolerance * 16);  // twice the integral of z^2
}

/// Regular everywhere: Gauss rules over evaluated samples are exact for all moments. By the divergence theorem with
/// fields along z alone, which the library does not use.
TEST(LimitIntegrals, OfARegularTorusAreThoseOfItsSamples) {
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  const Mesh mesh = jittered(torus(6, 5), 0.5);
  const LimitMap surface(scheme, mesh);
  std::vector<Place> samples;
  std::vector<double> weights;
  for (Index f = 0; f < surface.addresses().size(); ++f)
    for (const QuadraturePoint& p : square_rule(10)) {
      samples.push_back({f, p.u, p.v});
      weights.push_back(p.weight);
    }
  const LimitSamples at = surface.evaluate(mesh.positions, samples, 1);
  double volume = 0, area = 0, second = 0;  // of x^2 + y^2
  Eigen::Vector2d first(0, 0);              // of x and y
  for (Eigen::Index i = 0; i < Eigen::Index(samples.size()); ++i) {
    const Eigen::Vector3d x = at.position.row(i), u = at.du.row(i), v = at.dv.row(i), N = u.cross(v);
    const double flux = weights[size_t(i)] * x.z() * N.z();
    volume += flux;
    first += flux * x.head<2>();
    second += flux * x.head<2>().squaredNorm();
    area += weights[size_t(i)] * N.norm();
  }
  const LimitIntegrals found = limit_integrals(surface, mesh.positions);
  ASSERT_TRUE(found.solid) << found.why_no_solid;
  EXPECT_NEAR(found.solid->volume, volume, moment_tolerance * volume);
  EXPECT_LE((found.solid->centroid.head<2>() - first / volume).norm(), moment_tolerance * diagonal(mesh.positions));
  EXPECT_NEAR(found.solid->inertia(2, 2), second - first.squaredNorm() / volume, moment_tolerance * second);
  constexpr double whole_squares = 1e-6;  // these rules do not halve squares
  EXPECT_NEAR(found.area, area, whole_squares * area);
}

class Integrals : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(Integrals, AreTheSameFromTheNextLevel) {
  const Scheme<double> scheme = GetParam().scheme();
  const Mesh mesh = closed_mesh(scheme);
  const LimitIntegrals found = integrals(scheme, mesh);
  EXPECT_LE(found.area_error, (has_polynomials(scheme) ? area_tolerance : refined_tolerance) * found.area);
  EXPECT_LE(found.solid->volume_error, (has_polynomials(scheme) ? 0 : refined_tolerance) * found.solid->volume);
  expect_equal(found, refined_integrals(scheme, mesh), diagonal(mesh.positions));
}

TEST_P(Integrals, OfOpenMeshesHaveAnAreaAlone) {
  const Scheme<double> scheme = GetParam().scheme();
  const Index size = takes_triangles(scheme) ? 3 : 4;
  for (const Mesh& mesh :
       {jittered(fan(5, size, 2), 0.1), jittered(open_fan(4, size, 2), 0.1), jittered(open_fan(3, size), 0.1)}) {
    const LimitIntegrals found = integrals(scheme, mesh);
    EXPECT_FALSE(found.solid);
    EXPECT_TRUE(found.why_no_solid.starts_with("the surface is not closed at edge (")) << found.why_no_solid;
    // Pieces at borders of mid-edge are polynomials on no level.
    const bool is_exact = has_polynomials(scheme) && scheme.name != "mid-edge";
    EXPECT_LE(found.area_error, (is_exact ? area_tolerance : refined_tolerance) * found.area);
    expect_equal_areas(found, refined_integrals(scheme, mesh), diagonal(mesh.positions));
  }
}

TEST_P(Integrals, MoveTurnAndScaleWithTheirPoints) {
  const Scheme<double> scheme = GetParam().scheme();
  const Mesh mesh = closed_mesh(scheme);
  const LimitMap surface(scheme, mesh);
  const LimitIntegrals a = limit_integrals(surface, mesh.positions);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(3, -5, 7);
  for (const double scale : {1e-60, 1.5, 1e50}) {
    const Points moved = scale * ((mesh.positions * R.transpose()).rowwise() + shift.transpose());
    LimitIntegrals b = limit_integrals(surface, moved);
    // Back again.
    b.area /= scale * scale;
    b.area_error /= scale * scale;
    b.centroid_error /= scale;
    b.centroid = R.transpose() * (*b.centroid / scale - shift);
    ASSERT_TRUE(b.solid) << b.why_no_solid;
    b.solid->volume /= std::pow(scale, 3);
    b.solid->volume_error /= std::pow(scale, 3);
    b.solid->centroid_error /= scale;
    b.solid->inertia_error /= std::pow(scale, 5);
    b.solid->centroid = R.transpose() * (b.solid->centroid / scale - shift);
    b.solid->inertia = R.transpose() * (b.solid->inertia / std::pow(scale, 5)) * R;
    expect_equal(a, b, 4 * diagonal(mesh.positions));  // the shift costs digits
  }
  const LimitIntegrals mirrored = limit_integrals(surface, -mesh.positions);
  EXPECT_NEAR(mirrored.solid->volume, -a.solid->volume, moment_tolerance * std::pow(diagonal(mesh.positions), 3));
}

/// The volume of level k differs from that of the limit by about a quarter of what that of the level before does; where
/// edges become a third as long, by a ninth.
TEST_P(Integrals, AreWhatRefinedMeshesTendTo) {
  const Scheme<double> scheme = GetParam().scheme();
  const Mesh mesh = closed_mesh(scheme);
  const LimitIntegrals found = integrals(scheme, mesh);
  const std::vector<Level> levels = refine(scheme, mesh, 5 * scheme.period);
  Points x = mesh.positions;
  std::vector<double> error;
  for (size_t k = 1; k < levels.size(); ++k) {
    x = levels[k].S * x;
    if (levels[k].number % scheme.period != 0) continue;
    error.push_back(volume_of(levels[k].topology(), x) - found.solid->volume);
  }
  constexpr double of_last_level = 2e-3;  // errors fall with the square of the size of faces
  constexpr double extrapolated = 1e-5;   // by one power of that size more
  EXPECT_LE(std::abs(error.back()), of_last_level * std::abs(found.solid->volume));
  const double finer = std::pow(scheme.dilation(), 2);
  EXPECT_LE(std::abs((finer * error[4] - error[3]) / (finer - 1)), extrapolated * std::abs(found.solid->volume));
}

INSTANTIATE_TEST_SUITE_P(Polynomials, Integrals, ::testing::ValuesIn(with_polynomials), test_name);
INSTANTIATE_TEST_SUITE_P(Refined, Integrals, ::testing::ValuesIn(without_polynomials), test_name);

TEST(LimitIntegrals, LeaveHolesOut) {
  Mesh mesh = cube();
  mesh.holes = {2};
  const LimitIntegrals found = integrals("bilinear", mesh);
  EXPECT_NEAR(found.area, 20, area_tolerance * 20);
  EXPECT_FALSE(found.solid);
  EXPECT_TRUE(found.why_no_solid.starts_with("the surface is not closed at edge (")) << found.why_no_solid;
  mesh.holes = {0, 1, 2, 3, 4, 5};
  const LimitIntegrals none = integrals("bilinear", mesh);
  EXPECT_EQ(none.area, 0);
  EXPECT_FALSE(none.centroid);
  EXPECT_EQ(none.why_no_solid, "there are no faces");
}

TEST(LimitIntegrals, OfSheetsThatMeetAtAnEdgeAreTheSumOfBoth) {
  Mesh other = cube();
  other.positions.col(0).array() += 2;
  other.positions.col(1).array() += 2;
  const Mesh mesh = glued(cube(), other, {3, 7}, {0, 4});
  const LimitIntegrals found = integrals("bilinear", mesh);
  ASSERT_TRUE(found.solid) << found.why_no_solid;
  EXPECT_NEAR(found.solid->volume, 16, moment_tolerance * 16);
  EXPECT_LE((found.solid->centroid - Eigen::Vector3d(1, 1, 0)).norm(), moment_tolerance * diagonal(mesh.positions));
  EXPECT_NEAR(found.area, 48, area_tolerance * 48);
}

TEST(LimitIntegrals, SaysWhyThereIsNoSolid) {
  EXPECT_TRUE(integrals("bilinear", mobius_strip(5)).why_no_solid.starts_with("the surface is not closed at edge ("));
  Mesh flat = cube();
  flat.positions.col(2).setZero();
  const LimitIntegrals found = integrals("catmull-clark", flat);
  EXPECT_EQ(found.why_no_solid, "the surface encloses no volume");
  EXPECT_GT(found.area, 0);
  Mesh point = cube();
  point.positions.setConstant(3);
  const LimitIntegrals nothing = integrals("catmull-clark", point);
  EXPECT_EQ(nothing.area, 0);
  EXPECT_FALSE(nothing.centroid);
}

/// Of a sheet that turns back inside a piece: its area is that of both layers, the line where it turns a kink that
/// quarters come near to.
TEST(LimitIntegrals, OfAFoldedSheetHaveAnErrorThatHolds) {
  constexpr Index n = 6;
  Mesh sheet = grid(n, n);
  const double x[] = {0, 1, 2, 1.7, 0.4, -1, -2.2};
  for (Index v = 0; v < sheet.num_vertices(); ++v) sheet.positions.row(v) << x[v % (n + 1)], v / (n + 1), 0;
  const LimitMap surface(*find_scheme<double>("catmull-clark"), sheet);
  const LimitIntegrals found = limit_integrals(surface, sheet.positions);
  // x depends on one parameter, y on the other: the area is the way that x goes there and back, times that of y.
  constexpr int steps = 1 << 12;
  std::vector<Place> places;
  for (Index face = 0; face < n; ++face)
    for (int i = 0; i <= steps; ++i) places.push_back({face, double(i) / steps, 0});
  const Points at = surface.evaluate(sheet.positions, places).position;
  double way = 0, turned = 0;
  for (Eigen::Index i = 1; i < at.rows(); ++i) {
    const double step = at(i, 0) - at(i - 1, 0);
    way += std::abs(step);
    turned += step < 0;
  }
  EXPECT_GT(turned, 0) << "the grid's first faces go along x";
  // Only in the step that turns back something of the way is lost: less than the step's square times x'' <= 4.
  const double lost = 4.0 / steps / steps * n;
  EXPECT_NEAR(found.area, way * n, found.area_error + lost * n);
  EXPECT_LT(found.area_error, 1e-3 * found.area);
  EXPECT_GT(found.area_error, 0) << "it is no rounding";
}

TEST(LimitIntegrals, RefusesWhatHasNone) {
  const LimitMap surface(*find_scheme<double>("catmull-clark"), cube());
  Points points = cube().positions;
  expect_error<InvalidParameter>([&] { limit_integrals(surface, points.topRows(7)); }, {"for each vertex"});
  points(3, 1) = NAN;
  expect_error<InvalidMesh>([&] { limit_integrals(surface, points); }, {"finite"});
}

}  // namespace
}  // namespace sublimit::testing

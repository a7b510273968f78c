// SPDX-License-Identifier: Apache-2.0
// The truth about limit surfaces, tested by what it must be whatever the scheme: splines on regular meshes, the same
// from later levels, derivatives that are limits of differences, the limits of vertices, one surface from both sides of
// an edge.
#include "truth/limit_truth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "laws/full_sweep.h"
#include "meshes/hard_meshes.h"
#include "meshes/places.h"
#include "sublimit/limit/detail/limit_points.h"
#include "support/tolerance.h"
#include "truth/regular_limit.h"

namespace sublimit::testing {
namespace {

using Vector = TruePoint::Vector;

/// Of numbers with 77 digits, after what scaling by 2^depth takes from second derivatives.
constexpr double precise_rounding = 1e-40;
/// Of the truth where there are no polynomial pieces, relative to the points.
constexpr double refined_enough = 1e-16;
/// Of its first derivatives there, relative to themselves: refined until they change by less (limit_truth.h).
constexpr double refined_derivatives = 1e-12;
/// Of differences over 2^-30, relative to second derivatives: the step's square times third derivatives a thousand
/// times as large; the step times a hundred, where the derivative itself bends.
constexpr double smooth_differences = 1e-15, bent_differences = 1e-7;
/// Of points at 2^-40 from a vertex to it: 0.85^40 at the largest of the subdominant eigenvalues here, with room.
constexpr double near_vertex = 1e-2;

double difference(const Vector& a, const Vector& b) {
  return static_cast<double>(Precise((a - b).cwiseAbs().maxCoeff()));
}
double size(const Vector& a) { return static_cast<double>(Precise(a.cwiseAbs().maxCoeff())); }

struct Tested {
  Scheme<double> scheme;
  Scheme<Precise> precise;
  std::string name;
  bool triangles() const { return scheme.face_size() == 3; }
  bool is_polynomial() const { return !scheme.claims.limit.starts_with("no "); }
};

std::vector<Tested> schemes(bool polynomial_only = false, int largest_degree = 5) {
  std::vector<Tested> result;
  const auto add = [&](const std::string& name, const SchemeOptions& options = {}, const std::string& suffix = "") {
    result.push_back({find_scheme(name, options).value(), find_scheme<Precise>(name, options).value(), name + suffix});
  };
  for (const char* name : {"bilinear", "catmull-clark", "loop", "loop-warren", "doo-sabin", "doo-sabin-averaging",
                           "mid-edge", "mid-edge-habib-warren"})
    add(name);
  for (int d = 2; d <= largest_degree; ++d) add("averaging", {{"degree", std::to_string(d)}}, "_" + std::to_string(d));
  if (polynomial_only) return result;
  for (const char* name : {"butterfly", "modified-butterfly", "sqrt3", "interpolatory-sqrt3", "kobbelt"}) add(name);
  return result;
}

Level level_of(const Tested& t, const Mesh& mesh) { return control_level(t.scheme, mesh, SubdivisionOptions{}); }

/// With all that the scheme takes; even seeds with borders.
Mesh hard_mesh(const Tested& t, unsigned seed) {
  const Hardness hardness{.open = seed % 2 == 0,
                          .sharp = t.scheme.sharpening == Sharpening::sharp,
                          .semi_sharp = t.scheme.sharpening == Sharpening::semi_sharp};
  return t.triangles() ? hard_triangles(seed, hardness) : hard_polygons(seed, hardness);
}

/// Value and derivatives agree, where both have them.
void expect_same(const TruePoint& a, const TruePoint& b, const std::string& where) {
  if (!a.has_position || !b.has_position) return;
  const double tolerance = a.is_exact && b.is_exact ? precise_rounding : refined_enough;
  EXPECT_LE(difference(a.position, b.position), tolerance) << where;
  EXPECT_EQ(a.has_first, b.has_first) << where;
  if (!a.has_first) return;
  const double first = a.is_exact && b.is_exact ? tolerance : refined_derivatives;
  const auto relative = [&](const Vector& x, const Vector& y) {
    EXPECT_LE(difference(x, y), first * (1 + size(x))) << where;
  };
  relative(a.du, b.du), relative(a.dv, b.dv);
  if (a.has_second && b.has_second) relative(a.duu, b.duu), relative(a.duv, b.duv), relative(a.dvv, b.dvv);
}

std::string words(const Tested& t, const Place& s) {
  return t.name + " at " + std::to_string(s.face) + ": " + std::to_string(s.u) + ", " + std::to_string(s.v);
}

TEST(LimitTruth, IsASplineOnRegularMeshes) {
  const BoxSpline quartic({{1, 0}, {0, 1}, {1, 1}}, {2, 2, 2}),
      zwart_powell({{1, 0}, {0, 1}, {1, 1}, {1, -1}}, {1, 1, 1, 1});
  const Index m = 12, n = 11;
  for (const Tested& t : schemes(true, 9)) {
    const bool triangles = t.triangles();
    const Mesh mesh = jittered(triangles ? triangle_torus(m, n) : torus(m, n), 0.3);
    const Level level = level_of(t, mesh);
    const int degree = t.scheme.name == "bilinear" ? 1 : t.scheme.claims.regular + 1;
    const auto phi = [&](double x, double y) {
      if (triangles) return quartic(x, y);
      if (t.scheme.name.starts_with("mid-edge")) return zwart_powell(x, y);
      return cardinal_bspline(degree, x) * cardinal_bspline(degree, y);
    };
    const auto wrapped = [](double x, double period) { return x - period * std::round(x / period); };
    for (const Place& s : random_places(Addresses(level.topology(), triangles), 6, 3)) {
      // Vertex (i,j) has number i n + j; corners of faces tell where the place is.
      const auto corners = level.topology().vertices(Face{s.face});
      const Index a = corners[0], b = corners[1], c = corners[triangles ? 2 : 3];
      const auto step = [&](Index to) {
        return Eigen::Vector2d(wrapped(to / n - a / n, m), wrapped(to % n - a % n, n));
      };
      const Eigen::Vector2d place = Eigen::Vector2d(a / n, a % n) + s.u * step(b) + s.v * step(c);
      Eigen::RowVector3d expected(0, 0, 0);
      for (Index v = 0; v < m * n; ++v)
        expected += phi(wrapped(place[0] - v / n, m), wrapped(place[1] - v % n, n)) * mesh.positions.row(v);
      const TruePoint truth = true_limit(t.precise, level, mesh.positions, s);
      EXPECT_TRUE(truth.is_exact);
      EXPECT_EQ(truth.levels, 0) << words(t, s);
      EXPECT_LE((truth.position.cast<double>().transpose() - expected).cwiseAbs().maxCoeff(), rounding(100, 5))
          << words(t, s);
    }
  }
}

/// Of two seeds, one with and one without borders: schemes take them in turn, the full sweep takes both.
std::vector<unsigned> seeds_in_turn(unsigned first, size_t number) {
  if (full_sweep()) return {first, first + 1};
  return {first + static_cast<unsigned>(number % 2)};
}

/// The regular pieces of hard meshes, borders and creases included, are the same from every level.
TEST(LimitTruth, IsTheSameFromLaterLevelsAndWiderParts) {
  size_t number = 0;
  for (const Tested& t : schemes(false, 9)) {
    const bool triangles = t.triangles();
    for (const unsigned seed : seeds_in_turn(1, number++)) {
      const Mesh mesh = hard_mesh(t, seed);
      const Level level = level_of(t, mesh);
      for (const Place& s : random_places(Addresses(level.topology(), triangles), t.is_polynomial() ? 8 : 2, seed)) {
        const TruePoint truth = true_limit(t.precise, level, mesh.positions, s);
        expect_same(
            truth, true_limit(t.precise, level, mesh.positions, s, {.least_levels = truth.levels + 2, .more_rings = 1}),
            words(t, s) + " seed " + std::to_string(seed) + " levels " + std::to_string(truth.levels));
      }
    }
  }
}

/// Differences over 2^-30: their own error is that squared, times the next derivatives.
TEST(LimitTruth, DerivativesAreLimitsOfDifferences) {
  const double h = std::ldexp(1.0, -30);
  const Precise step(h);
  for (const Tested& t : schemes(true)) {
    const Mesh mesh = hard_mesh(t, 3);
    const Level level = level_of(t, mesh);
    for (const Place& s : random_places(Addresses(level.topology(), t.triangles()), 5, 7)) {
      const auto at = [&](double u, double v) {
        return true_limit(t.precise, level, mesh.positions, {s.face, s.u + u, s.v + v}).position;
      };
      const TruePoint truth = true_limit(t.precise, level, mesh.positions, s);
      ASSERT_TRUE(truth.has_first) << words(t, s);
      const Vector c = at(0, 0), e = at(h, 0), w = at(-h, 0), n = at(0, h), o = at(0, -h);
      const Vector du = (e - w) / (2 * step), dv = (n - o) / (2 * step);
      // First derivatives of C^1 schemes may bend here, of bilinear ones only in polygons' squares.
      const double near = truth.has_second ? smooth_differences : bent_differences;
      const double largest = 1 + size(truth.duu) + size(truth.dvv);
      EXPECT_LE(difference(truth.du, du), near * largest) << words(t, s);
      EXPECT_LE(difference(truth.dv, dv), near * largest) << words(t, s);
      if (!truth.has_second) continue;
      const Vector duu = (e - 2 * c + w) / (step * step), dvv = (n - 2 * c + o) / (step * step);
      const Vector duv = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * step * step);
      // The third derivatives of bicubic pieces jump.
      EXPECT_LE(difference(truth.duu, duu), bent_differences * largest) << words(t, s);
      EXPECT_LE(difference(truth.duv, duv), bent_differences * largest) << words(t, s);
      EXPECT_LE(difference(truth.dvv, dvv), bent_differences * largest) << words(t, s);
    }
  }
}

TEST(LimitTruth, EndsInTheLimitsAndNormalsOfVertices) {
  int normals = 0;
  size_t number = 0;
  for (const Tested& t : schemes())
    for (const unsigned seed : seeds_in_turn(5, number++)) {
      const Mesh mesh = hard_mesh(t, seed);
      const Level level = level_of(t, mesh);
      const Topology& topology = level.topology();
      const Addresses addresses(topology, t.triangles());
      LimitCache cache(t.scheme);
      // Masks of a level whose faces need no preparation.
      const bool is_prepared = t.scheme.preparation.empty();
      Level first = is_prepared ? level : next_level(t.scheme, level);
      const Points points = is_prepared ? mesh.positions : Points(first.S * mesh.positions);
      const LimitMatrices matrices = limit_matrices(first, cache);
      const LimitPoints limits = limit_points(matrices, first.topology(), points);
      const Index count = topology.num_half_edges(), stride = t.is_polynomial() ? count / 9 : count / 3;
      for (Index i = 0; i < count; i += stride) {
        const HalfEdge corner{i};
        const TruePoint truth =
            true_limit(t.precise, level, mesh.positions, from_corner(topology, addresses, corner, 0, 0));
        if (!truth.has_position) continue;
        const std::string where = t.name + " seed " + std::to_string(seed) + " corner " + std::to_string(i);
        const Eigen::RowVector3d position = truth.position.cast<double>().transpose();
        EXPECT_LE((position - limits.position.row(index(topology.tail(corner)))).cwiseAbs().maxCoeff(), reference)
            << where;
        if (!truth.has_first || t.scheme.claims.regular < 1 || !is_prepared) continue;
        const Index side = matrices.corner_side[size_t(i)];
        if (limits.status[size_t(side)] == LimitStatus::undefined_normal) continue;
        const Eigen::Vector3d du = truth.du.cast<double>(), dv = truth.dv.cast<double>(),
                              normal = limits.normal.row(side);
        EXPECT_LE(du.cross(dv).normalized().cross(normal).norm(), reference_angle) << where;
        EXPECT_GT(du.cross(dv).dot(normal), 0) << where;
        ++normals;
      }
    }
  EXPECT_GE(normals, full_sweep() ? 20 : 10);  // the loop has compared some
}

TEST(LimitTruth, IsOneSurfaceAcrossEdges) {
  for (const Tested& t : schemes())
    for (const unsigned seed : {3u, 4u}) {
      const Mesh mesh = hard_mesh(t, seed);
      const Level level = level_of(t, mesh);
      const Topology& topology = level.topology();
      const Addresses addresses(topology, t.triangles());
      const Index count = topology.num_half_edges();
      for (Index i = 1; i < count; i += t.is_polynomial() ? count / 9 : count / 2) {
        const HalfEdge h{i}, g = topology.twin(h);
        if (!exists(g)) continue;
        const TruePoint left = true_limit(t.precise, level, mesh.positions, on_edge(topology, addresses, h, 0.375));
        const TruePoint right = true_limit(t.precise, level, mesh.positions, on_edge(topology, addresses, g, 0.625));
        if (!left.has_position || !right.has_position) continue;
        const double tolerance = left.is_exact && right.is_exact ? precise_rounding : refined_enough;
        EXPECT_LE(difference(left.position, right.position), tolerance)
            << t.name << " seed " << seed << " half-edge " << i;
      }
    }
}

/// Down to 2^-40 from an extraordinary vertex: positions come to its limit like the modulus of the next eigenvalue.
TEST(LimitTruth, ComesToExtraordinaryVertices) {
  for (const Tested& t : schemes(true)) {
    const Mesh mesh = hard_mesh(t, 7);
    const Level level = level_of(t, mesh);
    const Topology& topology = level.topology();
    const Addresses addresses(topology, t.triangles());
    HalfEdge corner{0};
    for (Index i = 0; i < topology.num_half_edges(); ++i)
      if (topology.num_faces(topology.tail(HalfEdge{i})) > topology.num_faces(topology.tail(corner)))
        corner = HalfEdge{i};
    double before = std::numeric_limits<double>::infinity();
    const TruePoint vertex =
        true_limit(t.precise, level, mesh.positions, from_corner(topology, addresses, corner, 0, 0));
    for (const int k : {2, 10, 20, 40}) {
      const double d = std::ldexp(1.0, -k);
      const TruePoint truth =
          true_limit(t.precise, level, mesh.positions, from_corner(topology, addresses, corner, d, d / 4));
      EXPECT_TRUE(truth.is_exact);
      EXPECT_LE(truth.levels, k + 8) << t.name;
      const double distance = difference(truth.position, vertex.position);
      EXPECT_LT(distance, before) << t.name << " at 2^-" << k;
      before = distance;
    }
    EXPECT_LT(before, near_vertex) << t.name;
  }
}

/// Regular borders of bidegree 2: control row i at parameter i. A point of level 1 beside the border, a quarter inside,
/// ends at (r_0 + 6 r_1 + r_2)/8 of the rows 0, 1/4 and 3/4, which is 9/32 inside.
TEST(LimitTruth, DualSurfacesStartInTheBorderRow) {
  for (const char* name : {"doo-sabin", "doo-sabin-averaging"}) {
    const Tested t{find_scheme(name).value(), find_scheme<Precise>(name).value(), name};
    const Mesh mesh = grid(5, 4);
    const Level level = level_of(t, mesh), first = next_level(t.scheme, level);
    LimitCache cache(t.scheme);
    const Points limits =
        limit_points(limit_matrices(first, cache), first.topology(), first.S * mesh.positions).position;
    const HalfEdge corner = level.topology().corner(Face{2}, 0);  // beside the border from corner 0 to 1
    ASSERT_FALSE(exists(level.topology().twin(corner)));
    const TruePoint truth = true_limit(t.precise, level, mesh.positions, {2, 0.25, 9.0 / 32});
    EXPECT_TRUE(truth.is_exact);
    EXPECT_LE((truth.position.cast<double>().transpose() - limits.row(index(corner))).cwiseAbs().maxCoeff(),
              rounding(64, 5));
    EXPECT_FALSE(true_limit(t.precise, level, mesh.positions, {2, 0.25, 9.0 / 32}, {.least_levels = 1}).has_second);
  }
}

}  // namespace
}  // namespace sublimit::testing

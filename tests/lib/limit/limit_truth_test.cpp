// SPDX-License-Identifier: Apache-2.0
// The truth about limit surfaces, tested by what it must be whatever the scheme: splines on regular meshes, the same
// from later levels, derivatives that are limits of differences, the limits of vertices, one surface from both sides of
// an edge.
#include "support/limit_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sublimit/analysis/limit_points.h"
#include "support/hard_meshes.h"
#include "support/irregular_meshes.h"
#include "support/regular_limit.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Vector = TruePoint::Vector;

/// Of numbers with 77 digits, after what scaling by 2^depth takes from second derivatives.
constexpr double precise_rounding = 1e-40;
/// Of the truth where there are no polynomial pieces, relative to the points.
constexpr double refined_enough = 1e-16;

double difference(const Vector& a, const Vector& b) {
  return static_cast<double>(Precise((a - b).cwiseAbs().maxCoeff()));
}
double size(const Vector& a) { return static_cast<double>(Precise(a.cwiseAbs().maxCoeff())); }

struct Tested {
  Scheme<double> scheme;
  Scheme<Precise> precise;
  std::string name;
};

std::vector<Tested> schemes(bool polynomial_only = false) {
  std::vector<Tested> result;
  const auto add = [&](const std::string& name, const SchemeOptions& options = {}, const std::string& suffix = "") {
    result.push_back({find_scheme(name, options).value(), find_scheme<Precise>(name, options).value(), name + suffix});
  };
  for (const char* name : {"bilinear", "catmull-clark", "loop", "loop-warren", "doo-sabin", "doo-sabin-averaging",
                           "mid-edge", "mid-edge-habib-warren"})
    add(name);
  for (int d = 2; d <= 9; ++d) add("averaging", {{"degree", std::to_string(d)}}, "_" + std::to_string(d));
  if (polynomial_only) return result;
  for (const char* name : {"butterfly", "modified-butterfly", "sqrt3", "interpolatory-sqrt3", "kobbelt"}) add(name);
  return result;
}

bool takes_triangles(const Tested& t) { return t.scheme.face_size() == 3; }

/// Random places, short binary numbers among them; away from the edges of triangles, so that neighbours of a place
/// exist.
std::vector<Sample> places(Index faces, bool triangles, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Sample> result;
  while (int(result.size()) < count) {
    const auto binary = [&] { return double(1 + random() % 1022) / 1024; };
    const double u = binary(), v = binary();
    if (triangles && u + v >= 1023 / 1024.0) continue;
    result.push_back({Index(random() % std::uint32_t(faces)), u, v});
  }
  return result;
}

Level level_of(const Tested& t, const ControlMesh& mesh) { return control_level(t.scheme, mesh, SubdivisionOptions{}); }

/// Value and derivatives agree.
void expect_same(const TruePoint& a, const TruePoint& b, const std::string& where) {
  ASSERT_EQ(a.has_position, b.has_position) << where;
  if (!a.has_position) return;
  const double tolerance = a.is_exact && b.is_exact ? precise_rounding : refined_enough;
  EXPECT_LE(difference(a.position, b.position), tolerance) << where;
  if (!a.is_exact || !b.is_exact) return;
  const auto relative = [&](const Vector& x, const Vector& y) {
    EXPECT_LE(difference(x, y), tolerance * (1 + size(x))) << where;
  };
  relative(a.du, b.du), relative(a.dv, b.dv);
  if (a.has_second && b.has_second) relative(a.duu, b.duu), relative(a.duv, b.duv), relative(a.dvv, b.dvv);
}

std::string words(const Tested& t, const Sample& s) {
  return t.name + " at " + std::to_string(s.face) + ": " + std::to_string(s.u) + ", " + std::to_string(s.v);
}

TEST(LimitTruth, IsASplineOnRegularMeshes) {
  const BoxSpline quartic({{1, 0}, {0, 1}, {1, 1}}, {2, 2, 2}),
      zwart_powell({{1, 0}, {0, 1}, {1, 1}, {1, -1}}, {1, 1, 1, 1});
  const Index m = 12, n = 11;
  for (const Tested& t : schemes(true)) {
    const bool triangles = takes_triangles(t);
    const ControlMesh mesh = jittered(triangles ? triangle_torus(m, n) : torus(m, n), 0.3);
    const Level level = level_of(t, mesh);
    const int degree = t.scheme.name == "bilinear" ? 1 : t.scheme.claims.regular + 1;
    const auto phi = [&](double x, double y) {
      if (triangles) return quartic(x, y);
      if (t.scheme.name.starts_with("mid-edge")) return zwart_powell(x, y);
      return cardinal_bspline(degree, x) * cardinal_bspline(degree, y);
    };
    const auto wrapped = [](double x, double period) { return x - period * std::round(x / period); };
    for (const Sample& s : places(level.topology().num_faces(), triangles, 6, 3)) {
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

/// The regular pieces of hard meshes, borders and creases included, are the same from every level.
TEST(LimitTruth, IsTheSameFromLaterLevelsAndWiderParts) {
  for (const Tested& t : schemes()) {
    const bool triangles = takes_triangles(t);
    for (const unsigned seed : {1u, 2u}) {
      Hardness hardness{.open = seed == 2};
      if (t.scheme.sharpening == Sharpening::semi_sharp) hardness.semi_sharp = true;
      if (t.scheme.sharpening == Sharpening::sharp) hardness.sharp = true;
      const ControlMesh mesh = triangles ? hard_triangles(seed, hardness) : hard_polygons(seed, hardness);
      const Level level = level_of(t, mesh);
      const Index faces = Addresses(level.topology(), triangles).size();
      const bool is_polynomial = !t.scheme.claims.limit.starts_with("no ");
      for (const Sample& s : places(faces, triangles, is_polynomial ? 12 : 2, seed)) {
        const TruePoint truth = true_limit(t.precise, level, mesh.positions, s);
        expect_same(
            truth, true_limit(t.precise, level, mesh.positions, s, {.least_levels = truth.levels + 2, .more_rings = 1}),
            words(t, s) + " seed " + std::to_string(seed) + " levels " + std::to_string(truth.levels));
      }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing

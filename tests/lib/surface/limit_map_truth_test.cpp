// SPDX-License-Identifier: Apache-2.0
// The limit surface against the truth (truth/limit_truth.h), for every scheme, on meshes that have everything at
// once: at random places, on edges, and towards irregular vertices down to 2^-40.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "meshes/shared_meshes.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"
#include "truth/limit_truth.h"

namespace sublimit::testing {
namespace {

using Vector = TruePoint::Vector;

/// Second derivatives: polynomials of degree 8 and 9 are interpolated, and derived twice at their ends.
constexpr double second_derivative_of_high_degrees = 1e-6;

double error(const Eigen::Vector3d& ours, const Vector& truth) { return double((ours.cast<Precise>() - truth).norm()); }

using Three = Eigen::Matrix<Precise, 3, 1>;

/// A surface beside the truth. What was compared is counted, so that no test passes by comparing nothing.
class Beside {
 public:
  Beside(const Scheme<double>& scheme, const Scheme<Precise>& precise, const Mesh& mesh)
      : precise_(precise),
        surface_(scheme, mesh),
        points_(mesh.positions),
        box_(diagonal(points_)),
        smoothness_(scheme.claims.regular) {}
  const LimitMap& surface() const { return surface_; }
  const Topology& topology() const { return surface_.level().topology(); }

  void compare(const Place& s) {
    const LimitStencil stencil = surface_.stencil(s, 2);
    if (stencil.status == LimitStatus::hole) return;
    std::ostringstream where;
    where.precision(17);
    where << "square " << s.face << " (" << s.u << ", " << s.v << "), " << name(stencil.status);
    SCOPED_TRACE(where.str());
    const TruePoint truth = true_limit(precise_, surface_.level(), points_, s);
    const LimitSamples ours = surface_.evaluate(points_, std::span(&s, 1), 2);
    ++places;
    if (truth.has_position) {
      EXPECT_LE(error(ours.position.row(0), truth.position), reference * box_);
    }
    if (!truth.has_first) return;
    EXPECT_GE(ours.order[0], 1);
    if (ours.order[0] < 1) return;
    ++first;
    const double rounding_of_truth = exact_digits * box_, least = vanishing(stencil, 1, 2) + rounding_of_truth,
                 first_error = std::max(first_derivative, 10 * truth.first_error);
    EXPECT_LE(error(ours.du.row(0), truth.du), first_error * double(truth.du.norm()) + least);
    EXPECT_LE(error(ours.dv.row(0), truth.dv), first_error * double(truth.dv.norm()) + least);
    // Faces with one vertex at several corners may be points or curves. What the truth has of their area is rounding,
    // whose direction says nothing: they have no normal.
    const Three cross = Three(truth.du).cross(Three(truth.dv));
    const bool has_area =
        cross.norm() > rounding_of_truth * std::max(Precise(truth.du.norm()), Precise(truth.dv.norm()));
    if (truth.is_exact && has_area) {
      EXPECT_LE(error(ours.normal.row(0), cross / cross.norm()), reference_angle);
    } else if (truth.is_exact && s.u > 0 && s.v > 0 && s.u < 1 && s.v < 1) {
      EXPECT_EQ(ours.normal.row(0), Eigen::RowVector3d::Zero());
    }
    if (!truth.has_second) return;
    // Where second derivatives jump, one-sided ones are not given; pieces with sharpness are cut in more places.
    if (smoothness_ < 2 && ours.order[0] == 1 && (ours.status[0] == LimitStatus::crease || smoothness_ == 0)) return;
    EXPECT_EQ(ours.order[0], 2);
    if (ours.order[0] < 2) return;
    ++second;
    // Relative to the largest: single ones may vanish.
    const double size = double(std::max({truth.duu.norm(), truth.duv.norm(), truth.dvv.norm()}));
    const double least2 = vanishing(stencil, 1, 5) + rounding_of_truth;
    const double tolerance = smoothness_ < 7 ? second_derivative : second_derivative_of_high_degrees;
    const auto expect_close = [&](const Eigen::Vector3d& x, const Vector& y) {
      EXPECT_LE(error(x, y), tolerance * size + least2);
    };
    expect_close(ours.duu.row(0), truth.duu);
    expect_close(ours.duv.row(0), truth.duv);
    expect_close(ours.dvv.row(0), truth.dvv);
  }

  /// What rounding leaves of derivatives that vanish: of the terms that cancel, in the largest row.
  double vanishing(const LimitStencil& stencil, int first_row, int rows) const {
    double largest = 0;
    for (int row = first_row; row < first_row + rows; ++row) {
      double terms = 0;
      for (size_t j = 0; j < stencil.vertices.size(); ++j)
        terms += std::abs(stencil.weights(row, Eigen::Index(j))) *
                 (points_.row(stencil.vertices[j]) - points_.row(stencil.vertices[0])).norm();
      largest = std::max(largest, terms);
    }
    return eigen(10) * largest;  // interpolation and two derivations cost digits
  }

  int places = 0, first = 0, second = 0;

 private:
  Scheme<Precise> precise_;
  LimitMap surface_;
  Points points_;
  double box_;
  int smoothness_;
};

class LimitSurfaceTruth : public ::testing::TestWithParam<TestedScheme> {
 protected:
  void SetUp() override {
    scheme_ = GetParam().scheme();
    precise_ = GetParam().scheme<Precise>();
  }
  bool triangles() const { return takes_triangles(scheme_); }
  /// With pieces that are polynomials: their truth is quick.
  bool quick() const { return has_polynomials(scheme_); }
  int count(int quick_ones, int slow_ones) const {
    return std::max(1, (quick() ? quick_ones : slow_ones) * (full_sweep() ? 10 : 1) / effort(scheme_));
  }
  std::vector<Mesh> meshes() const { return hard_meshes(scheme_, 1); }

  Scheme<double> scheme_;
  Scheme<Precise> precise_;
};

TEST_P(LimitSurfaceTruth, AtRandomPlaces) {
  int second = 0;
  for (const Mesh& mesh : meshes()) {
    Beside beside(scheme_, precise_, mesh);
    for (const Place& s : random_places(beside.surface().addresses(), count(25, 2), 7)) beside.compare(s);
    EXPECT_GE(beside.first, count(12, 1) / 4);
    second += beside.second;
  }
  EXPECT_EQ(second > 0, quick());
}

TEST_P(LimitSurfaceTruth, OnEdges) {
  for (const Mesh& mesh : meshes()) {
    Beside beside(scheme_, precise_, mesh);
    std::mt19937 random(3);
    for (int i = 0; i < count(16, 2); ++i) {
      const HalfEdge h{Index(random() % std::uint32_t(beside.topology().num_half_edges()))};
      const double s = double(1 + random() % 63) / 64;
      beside.compare(on_edge(beside.topology(), beside.surface().addresses(), h, s));
    }
  }
}

/// Every vertex is irregular somehow but for those of valence 4 (6) without anything sharp around.
TEST_P(LimitSurfaceTruth, TowardsVertices) {
  for (const Mesh& mesh : meshes()) {
    Beside beside(scheme_, precise_, mesh);
    const Topology& t = beside.topology();
    std::mt19937 random(5);
    for (int i = 0; i < count(40, 2);) {
      const HalfEdge corner{Index(random() % std::uint32_t(t.num_half_edges()))};
      const Vertex v = t.tail(corner);
      if (!t.is_boundary(v) && t.num_faces(v) == (triangles() ? 6 : 4) && random() % 4 != 0) continue;
      // All exponents in turn, along the diagonal, near one side, near the other, and on a side.
      const double d = std::ldexp(1.0, quick() ? -1 - i % 40 : -1 - int(random() % 40));
      const double directions[][2] = {{0.5, 0.5}, {0.625, 0.03125}, {0.0625, 0.75}, {0.5, 0}};
      const auto& [a, b] = directions[i / 3 % 4];
      beside.compare(from_corner(t, beside.surface().addresses(), corner, a * d, b * d));
      ++i;
    }
  }
}

/// Dual schemes have their irregular places in the middle of faces, and n-gons theirs; triangles have none.
class LimitSurfaceOfPolygonsTruth : public LimitSurfaceTruth {};

TEST_P(LimitSurfaceOfPolygonsTruth, TowardsCentresOfFaces) {
  for (const Mesh& mesh : meshes()) {
    Beside beside(scheme_, precise_, mesh);
    const Topology& t = beside.topology();
    std::mt19937 random(9);
    for (int i = 0; i < count(20, 1);) {
      const HalfEdge corner{Index(random() % std::uint32_t(t.num_half_edges()))};
      if (t.size(t.face(corner)) == 4) continue;
      const double d = std::ldexp(1.0, quick() ? -1 - (2 * i + 1) % 40 : -1 - int(random() % 40));
      const double a = i % 3 == 2 ? 0.125 : 1, b = i % 3 == 1 ? 0.25 : 0.5;
      beside.compare(from_corner(t, beside.surface().addresses(), corner, 1 - a * d, 1 - b * d));
      ++i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, LimitSurfaceTruth, ::testing::ValuesIn(schemes_and_degrees()), test_name);
INSTANTIATE_TEST_SUITE_P(Schemes, LimitSurfaceOfPolygonsTruth,
                         ::testing::ValuesIn(schemes_and_degrees_if([](const Scheme<double>& scheme) {
                           return !takes_triangles(scheme);
                         })),
                         test_name);

class SharedMeshSurface : public ::testing::TestWithParam<SharedMesh> {};

TEST_P(SharedMeshSurface, IsTheTruth) {
  const Mesh mesh = read_mesh(GetParam().path);
  if (mesh.num_faces() >= 400 && !full_sweep()) GTEST_SKIP() << "in the full sweep";
  Beside beside(find_scheme(GetParam().scheme).value(), find_scheme<Precise>(GetParam().scheme).value(), mesh);
  for (const Place& s : random_places(beside.surface().addresses(), full_sweep() ? 40 : 4, 1)) beside.compare(s);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedMeshSurface);
INSTANTIATE_TEST_SUITE_P(Full, SharedMeshSurface, ::testing::ValuesIn(shared_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing

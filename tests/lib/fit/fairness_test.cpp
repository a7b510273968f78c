// SPDX-License-Identifier: Apache-2.0
// The energy of a limit surface: a quadratic form, exact for polynomials.
#include "sublimit/fit/fairness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "laws/tested_schemes.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

double energy(const SparseMatrix& H, const Points& x) { return (x.transpose() * (H * x)).trace(); }

Points random_points(Index n, Index channels, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points x(n, channels);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = unit(random);
  return x;
}

TEST(Quadrature, IsExactForPolynomialsAsFarAsPromised) {
  for (int n = 1; n <= 8; ++n)
    for (int i = 0; i <= 2 * n - 1; ++i)
      for (int j = 0; j <= 2 * n - 1; ++j) {
        double square = 0, triangle = 0;
        for (const QuadraturePoint& p : square_rule(n)) square += p.weight * std::pow(p.u, i) * std::pow(p.v, j);
        for (const QuadraturePoint& p : triangle_rule(n)) triangle += p.weight * std::pow(p.u, i) * std::pow(p.v, j);
        EXPECT_NEAR(square, 1.0 / ((i + 1) * (j + 1)), rounding(n * n)) << n << ": u^" << i << " v^" << j;
        // i! j! / (i + j + 2)!
        if (i + j <= 2 * n - 2) {
          EXPECT_NEAR(triangle, std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3), rounding(n * n)) << n;
        }
      }
}

TEST(Fairness, IsSymmetricSemidefiniteAndFreeForConstants) {
  for (const char* name : {"bilinear", "catmull-clark", "loop", "doo-sabin"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    const LimitMap surface(scheme, hard_meshes(scheme, 2)[1]);
    for (const Fairness& fairness : {Fairness{.thin_plate = 1}, Fairness{.membrane = 2}}) {
      const Eigen::MatrixXd H(fairness_energy(surface, fairness));
      EXPECT_EQ(H, H.transpose());
      const double size = H.norm();
      EXPECT_GT(size, 1);
      const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(H);
      EXPECT_GE(eigenvalues[0], -rounding(100, size));
      // Nothing else is free of membrane energy on a connected mesh.
      if (fairness.membrane > 0) {
        EXPECT_GT(eigenvalues[1], 1e-3);
      }
      EXPECT_LE((H * Eigen::VectorXd::Ones(H.cols())).norm(), rounding(100, size));
    }
  }
}

/// A grid whose two outer rings of faces are holes, and the places of its vertices in the natural plane.
struct Plane {
  Mesh mesh;
  Points xy;
  double area = 0;
};

Plane plane(bool triangles) {
  constexpr Index m = 7, n = 8, border = 2;
  Plane result{triangles ? triangle_grid(m, n) : grid(m, n), Points((m + 1) * (n + 1), 2), 0};
  const auto at = [](Index v) { return std::pair{v % (m + 1), v / (m + 1)}; };
  // The third side of triangles runs along (1, 1) or (1, -1): it has length 1 too.
  const std::vector<Index>& corners = result.mesh.face_vertices;
  bool rising = false;
  for (int k = 0; k < 3; ++k) {
    const auto [i, j] = at(corners[size_t(k)]);
    const auto [i2, j2] = at(corners[size_t(k + 1) % 3]);
    rising |= (i2 - i) * (j2 - j) > 0;
  }
  const Eigen::RowVector2d e1(1, 0),
      e2 = triangles ? Eigen::RowVector2d(rising ? -0.5 : 0.5, std::sqrt(0.75)) : Eigen::RowVector2d(0, 1);
  for (Index v = 0; v < result.xy.rows(); ++v) result.xy.row(v) = at(v).first * e1 + at(v).second * e2;
  const size_t size = triangles ? 3 : 4;
  for (Index f = 0; f < result.mesh.num_faces(); ++f) {
    bool inside = true;
    for (size_t k = 0; k < size; ++k) {
      const auto [i, j] = at(corners[size_t(f) * size + k]);
      inside &= i >= border && j >= border && i <= m - border && j <= n - border;
    }
    if (inside)
      result.area += triangles ? std::sqrt(0.75) / 2 : 1;
    else
      result.mesh.holes.push_back(f);
  }
  return result;
}

TEST(Fairness, OfAQuadraticIsItsIntegral) {
  const std::vector<const char*> names{"catmull-clark", "loop", "doo-sabin", "mid-edge"};
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    const Plane p = plane(takes_triangles(scheme));
    const LimitMap surface(scheme, p.mesh);
    const SparseMatrix H = fairness_energy(surface, {.thin_plate = 1}), M = fairness_energy(surface, {.membrane = 1});
    const Eigen::ArrayXd x = p.xy.col(0), y = p.xy.col(1);
    // Control points of a quadratic have a limit with the same derivatives.
    const Points linear = 3 * x - 2 * y + 5, quadratic = x * x + 3 * x * y - 2 * y * y;
    const double scale = 100 * quadratic.squaredNorm();
    EXPECT_NEAR(energy(H, linear), 0, rounding(100, scale));
    EXPECT_NEAR(energy(M, linear), (9 + 4) * p.area, rounding(100, scale));
    EXPECT_NEAR(energy(H, quadratic), (4 + 2 * 9 + 16) * p.area, rounding(100, scale));
  }
}

TEST(Fairness, IsTheSumOverItsQuadraturePoints) {
  // Two points a side, as every table has them.
  const double a = 0.5 - std::sqrt(1.0 / 12), nodes[] = {a, 1 - a};
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  Mesh mesh = hard_polygons(3, {.open = true, .sharp = true});
  mesh.holes.push_back(2);
  const LimitMap surface(scheme, mesh);
  double expected = 0;
  std::vector<Place> places;
  for (Index f = 0; f < surface.addresses().size(); ++f)
    for (const double u : nodes)
      for (const double v : nodes) places.push_back({f, u, v});
  const LimitSamples s = surface.evaluate(mesh.positions, places, 2);
  for (size_t k = 0; k < places.size(); ++k) {
    const auto i = Eigen::Index(k);
    if (s.status[k] == LimitStatus::hole) continue;
    ASSERT_EQ(s.order[k], 2);
    // Corners of polygons other than quadrilaterals are squares of side 1/2.
    const double side = surface.addresses().place(places[k].face).corner < 0 ? 1 : 0.5;
    const double thin = s.duu.row(i).squaredNorm() + 2 * s.duv.row(i).squaredNorm() + s.dvv.row(i).squaredNorm();
    const double membrane = s.du.row(i).squaredNorm() + s.dv.row(i).squaredNorm();
    expected += 0.25 * (0.7 * thin / (side * side) + 0.4 * membrane);
  }
  const SparseMatrix H = fairness_energy(surface, {.thin_plate = 0.7, .membrane = 0.4, .quadrature = 2});
  EXPECT_NEAR(energy(H, mesh.positions), expected, other_route * expected);
}

TEST(Fairness, DoesNotDependOnTheCornerThatComesFirst) {
  Mesh mesh = triangle_torus(5, 4);
  const Scheme<double> scheme = *find_scheme<double>("loop");
  const Fairness fairness{.thin_plate = 1, .membrane = 1};
  const Eigen::MatrixXd H(fairness_energy(LimitMap(scheme, mesh), fairness));
  for (size_t f = 0; f < mesh.face_sizes.size(); f += 2)
    std::rotate(mesh.face_vertices.begin() + long(3 * f), mesh.face_vertices.begin() + long(3 * f + 1),
                mesh.face_vertices.begin() + long(3 * f + 3));
  const Eigen::MatrixXd turned(fairness_energy(LimitMap(scheme, mesh), fairness));
  EXPECT_LE((H - turned).norm(), other_route * H.norm());
}

TEST(Fairness, IsTheSameSurfaceAfterAStep) {
  // Of the dual ones too, whose pieces meet in the middle of squares, and on their diagonals.
  const std::pair<const char*, Mesh> cases[] = {{"catmull-clark", torus(5, 4)},
                                                {"loop", triangle_torus(5, 4)},
                                                {"doo-sabin", torus(4, 5)},
                                                {"mid-edge", torus(4, 5)},
                                                {"bilinear", prism(5)}};
  for (const auto& [name, mesh] : cases) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    std::vector<Level> levels = refine(scheme, mesh, scheme.period);
    const SparseMatrix P = refinement_matrix(levels);
    const LimitMap coarse(scheme, mesh), fine(scheme, std::move(levels.back()));
    const Points x = random_points(mesh.num_vertices(), 2, 7), y = P * x;
    const double thin = energy(fairness_energy(coarse, {.thin_plate = 1}), x),
                 membrane = energy(fairness_energy(coarse, {.membrane = 1}), x);
    // Per unit of the fine squares derivatives are halves and quarters, over four times the area.
    EXPECT_NEAR(energy(fairness_energy(fine, {.thin_plate = 1}), y), thin / 4, other_route * thin);
    EXPECT_NEAR(energy(fairness_energy(fine, {.membrane = 1}), y), membrane, other_route * membrane);
  }
}

TEST(Fairness, SaysWhatIsWrong) {
  const LimitMap surface(*find_scheme<double>("catmull-clark"), cube());
  const auto with = [&](const Fairness& f) { return [&surface, f] { fairness_energy(surface, f); }; };
  expect_error<InvalidParameter>(with({.thin_plate = -1}), {"thin plate", "-1", ">= 0"});
  expect_error<InvalidParameter>(with({.membrane = NAN}), {"membrane", "nan"});
  expect_error<InvalidParameter>(with({.membrane = 1, .quadrature = 9}), {"9", "1 to 8"});
  const LimitMap butterfly(*find_scheme<double>("butterfly"), octahedron());
  expect_error<InvalidParameter>([&] { fairness_energy(butterfly, {.thin_plate = 1}); }, {"thin plate", "membrane"});
  EXPECT_GT(fairness_energy(butterfly, {.membrane = 1}).norm(), 0);
  EXPECT_EQ(fairness_energy(surface, {}).nonZeros(), 0);
}

}  // namespace
}  // namespace sublimit::testing

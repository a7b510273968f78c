// SPDX-License-Identifier: Apache-2.0
// Sums that are extrapolated from refined meshes, against exact ones.
#include "sublimit/integrals/detail/refined_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laws/tested_schemes.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/integrals/detail/sequence_limit.h"
#include "sublimit/integrals/limit_integrals.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

TEST(SequenceLimit, DropsPowers) {
  std::vector<double> simple, twice, turning;
  for (int k = 0; k < 7; ++k) {
    simple.push_back(3 + std::pow(0.25, k) - 2 * std::pow(0.5, k) + 0.5 * std::pow(-0.25, k));
    twice.push_back(3 + (2 + 5 * k) * std::pow(0.25, k));
    turning.push_back(3 + std::pow(-0.5, k));
  }
  for (const std::vector<double>& s : {simple, twice, turning}) {
    EXPECT_NEAR(sequence_limit(s), 3, rounding(1000, 3));
    EXPECT_GE(std::abs(s.back() - 3), 1e-3);
  }
}

TEST(SequenceLimit, OfNoDifferencesIsTheLastNumber) {
  EXPECT_EQ(sequence_limit(std::vector<double>{2}), 2);
  EXPECT_EQ(sequence_limit(std::vector<double>{2, 5}), 5);
  EXPECT_EQ(sequence_limit(std::vector<double>{2, 2, 2, 2}), 2);
  EXPECT_EQ(sequence_limit(std::vector<double>{1, 2, 3, 4}), 4);  // it has none
  const double next = std::nextafter(2, 3);
  EXPECT_EQ(sequence_limit(std::vector<double>{2, next, 2, next, 2}), 2);
}

/// Sums of this mesh as if its scheme had no polynomials, on levels of up to so many faces.
EstimatedSums refined(const Scheme<double>& scheme, const Mesh& mesh, std::int64_t most_faces) {
  return refined_sums(control_level(scheme, mesh), mesh.positions, scheme, {.most_faces = most_faces});
}

/// Errors that are told from 2^17 faces, of the whole: at extraordinary vertices, where powers are nearest to 1.
constexpr double told_of_many = 2e-4;

/// Of few levels as of many, an error is no less than what it is the error of.
TEST(RefinedSums, AreThoseOfPolynomialsWithinTheirErrors) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin", "mid-edge"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    const bool triangles = takes_triangles(scheme);
    const Index size = triangles ? 3 : 4;
    std::vector<Mesh> meshes{jittered(triangles ? octahedron() : cube(), 0.2),
                             jittered(triangles ? triangle_torus(6, 5) : torus(6, 5), 0.1)};
    if (!triangles) meshes.push_back(jittered(pole(8), 0.1));
    if (scheme.name != "mid-edge")
      for (const Index n : {3, 5, 9}) meshes.push_back(jittered(fan(n, size, 2), 0.1));
    for (const Mesh& mesh : meshes) {
      const LimitIntegrals exact = limit_integrals(LimitMap(scheme, mesh), mesh.positions);
      for (const std::int64_t most_faces : {1 << 10, 1 << 14, 1 << 17}) {
        SCOPED_TRACE(std::string(name) + ", " + std::to_string(mesh.positions.rows()) + " vertices, " +
                     std::to_string(most_faces) + " faces");
        const EstimatedSums found = refined(scheme, mesh, most_faces);
        EXPECT_NEAR(found.value.area, exact.area, found.error.area + exact.area_error);
        // The exact centroid has no error of its own: as much as the area has, at any distance in the mesh.
        const double of_exact = exact.area_error * diagonal(mesh.positions);
        EXPECT_LE((found.value.of_area - exact.area * *exact.centroid).norm(), found.error.of_area.norm() + of_exact);
        if (most_faces == 1 << 17) {
          EXPECT_LE(found.error.area, told_of_many * exact.area);
        }
        if (!exact.solid) continue;
        const SolidIntegrals& solid = *exact.solid;
        const Eigen::Matrix3d central = solid.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - solid.inertia;
        const Eigen::Matrix3d second = central + solid.volume * solid.centroid * solid.centroid.transpose();
        const double sums = rounding(1000, exact.area * std::pow(diagonal(mesh.positions), 3));
        EXPECT_LE((found.value.first - solid.volume * solid.centroid).norm(), found.error.first.norm() + sums);
        EXPECT_LE((found.value.second - second).norm(), found.error.second.norm() + sums);
        EXPECT_NEAR(found.value.volume, exact.solid->volume, found.error.volume + rounding(1000, exact.area));
        if (most_faces == 1 << 17) {
          EXPECT_LE(found.error.volume, told_of_many * exact.solid->volume);
        }
      }
    }
  }
}

/// z = p(x, y) of degree 2 over a regular grid stays itself under these schemes, so that its area is an integral over
/// the plane. All faces but a square in the middle are holes: borders are not reproduced.
TEST(RefinedSums, OfAParaboloidAreItsArea) {
  constexpr Index side = 16, first = 6, last = 10;
  const auto height = [](double x, double y) { return x * x / 8 - y * y / 16 + x * y / 16; };
  for (const char* name : {"butterfly", "kobbelt"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    SCOPED_TRACE(name);
    Mesh mesh = takes_triangles(scheme) ? triangle_grid(side, side) : grid(side, side);
    const Index faces_a_square = takes_triangles(scheme) ? 2 : 1;
    for (Index j = 0; j <= side; ++j)
      for (Index i = 0; i <= side; ++i) {
        const double x = i - side / 2, y = j - side / 2;
        mesh.positions.row(j * (side + 1) + i) << x, y, height(x, y);
      }
    const Topology t(view(mesh));
    Index kept = 0;
    for (Index f = 0; f < t.num_faces(); ++f) {
      bool inside = true;
      for (const Index v : t.vertices(Face{f})) {
        const Index i = v % (side + 1), j = v / (side + 1);
        inside &= i >= first && i <= last && j >= first && j <= last;
      }
      kept += inside;
      if (!inside) mesh.holes.push_back(f);
    }
    ASSERT_EQ(kept, 16 * faces_a_square);
    double area = 0;
    for (const QuadraturePoint& p : square_rule(20)) {
      const double x = first - side / 2 + p.u * (last - first), y = first - side / 2 + p.v * (last - first);
      area += p.weight * (last - first) * (last - first) *
              std::sqrt(1 + std::pow(x / 4 + y / 16, 2) + std::pow(x / 16 - y / 8, 2));
    }
    const EstimatedSums found = refined(scheme, mesh, 1 << 19);
    EXPECT_NEAR(found.value.area, area, found.error.area);
    constexpr double of_many_samples = 1e-6;  // what half a million of them leave
    EXPECT_LE(found.error.area, of_many_samples * area);
  }
}

/// Faces of their levels lie on several of the mesh: no region is left for an area.
TEST(RefinedSums, RefuseHolesThatAreNoFacesOfLevels) {
  for (const char* name : {"sqrt3", "interpolatory-sqrt3"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    Mesh mesh = triangle_torus(6, 5);
    mesh.holes = {0, 1};
    expect_error<UnsupportedTopology>([&] { limit_integrals(LimitMap(scheme, mesh), mesh.positions); },
                                      {name, "holes"});
  }
}

}  // namespace
}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
// Closed forms from the literature, checked against the eigenvectors: they live here, never in the library.
#include "sublimit/limit/detail/limit_cache.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/neighborhood/local_matrix.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Closed forms and eigenvectors at valences 3 to 50.
constexpr double closed_form = 1e-13;
using std::numbers::pi;

CanonicalNeighborhood smooth_type(int n, int face_size) {
  const Topology t(view(fan(n, face_size)));
  return neighborhood(t, initial_sharpness(t, {}, Boundary::edge_and_corner, Creasing::uniform), Vertex{0}).type;
}
CanonicalNeighborhood boundary_type(int m, int face_size) {
  const Topology t(view(open_fan(m, face_size)));
  return neighborhood(t, initial_sharpness(t, {}, Boundary::edge_only, Creasing::uniform), Vertex{0}).type;
}

std::vector<double> sorted_eigenvalues(const DenseMatrix<double>& A, double imaginary = 1e-6) {
  std::vector<double> values;
  for (const std::complex<double> v : eigenvalues(A)) {
    EXPECT_LE(std::abs(v.imag()), imaginary);
    values.push_back(v.real());
  }
  std::sort(values.begin(), values.end());
  return values;
}

double catmull_clark_lambda(double c, double sign) { return (5 + c + sign * std::sqrt((c + 1) * (c + 9))) / 16; }

// Halstead, Kass, DeRose 1993: (n^2 v + 4 sum e_i + sum f_i) / (n (n + 5)).
TEST(LimitMasks, CatmullClarkPositionMatchesHalstead1993) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  for (int n = 3; n <= 50; ++n) {
    const LimitMasks masks = limit_masks(scheme, smooth_type(n, 4));
    ASSERT_EQ(masks.position.size(), 2 * n + 1);
    const double sum = n * (n + 5.0);
    EXPECT_NEAR(masks.position[0], n * n / sum, closed_form) << n;
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(masks.position[1 + 2 * i], 4 / sum, closed_form) << n;
      EXPECT_NEAR(masks.position[2 + 2 * i], 1 / sum, closed_form) << n;
    }
  }
}

// Tangents: A cos(2 pi i/n) e_i + (cos(2 pi i/n) + cos(2 pi (i+1)/n)) f_i, A = 1 + c + cos(pi/n) sqrt(2 (9 + c)); the
// second tangent of the pair has sines. Ours are scaled so that the characteristic map has its first edge at
// distance 1.
TEST(LimitMasks, CatmullClarkTangentsMatchTheClosedForm) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  for (int n = 3; n <= 50; ++n) {
    const LimitMasks masks = limit_masks(scheme, smooth_type(n, 4));
    ASSERT_EQ(masks.sides.size(), 1u);
    const LimitMasks::Side& side = masks.sides[0];
    const double c = std::cos(2 * pi / n), A = 1 + c + std::cos(pi / n) * std::sqrt(2 * (9 + c));
    Eigen::VectorXd t1 = Eigen::VectorXd::Zero(2 * n + 1), t2 = t1;
    for (int i = 0; i < n; ++i) {
      t1[1 + 2 * i] = A * std::cos(2 * pi * i / n);
      t2[1 + 2 * i] = A * std::sin(2 * pi * i / n);
      t1[2 + 2 * i] = std::cos(2 * pi * i / n) + std::cos(2 * pi * (i + 1) / n);
      t2[2 + 2 * i] = std::sin(2 * pi * i / n) + std::sin(2 * pi * (i + 1) / n);
    }
    EXPECT_LE((side.tangent1.normalized() - t1.normalized()).norm(), closed_form) << n;
    EXPECT_LE((side.tangent2.normalized() - t2.normalized()).norm(), closed_form) << n;
    EXPECT_NEAR(side.lambda1, catmull_clark_lambda(c, 1), closed_form) << n;
    EXPECT_EQ(side.plane, LimitMasks::Plane::yes) << n;
  }
}

// Limit of Loop's scheme: centre 3/(3 + 8 beta), each neighbour 8 beta/(n (3 + 8 beta)); tangents cos and sin of 2 pi
// i/n.
TEST(LimitMasks, LoopMatchesLoop1987AndWarren1995) {
  for (const std::string name : {"loop", "loop-warren"}) {
    const Scheme<double> scheme = find_scheme(name).value();
    for (int n = 3; n <= 50; ++n) {
      const double c = std::cos(2 * pi / n), a = 3.0 / 8 + c / 4;
      const double beta = name == "loop" ? 5.0 / 8 - a * a : n == 3 ? 9.0 / 16 : 3.0 / 8;
      const LimitMasks masks = limit_masks(scheme, smooth_type(n, 3));
      EXPECT_NEAR(masks.position[0], 3 / (3 + 8 * beta), closed_form) << n;
      const LimitMasks::Side& side = masks.sides.at(0);
      EXPECT_NEAR(side.lambda1, a, closed_form) << n;
      for (int i = 0; i < n; ++i) {
        EXPECT_NEAR(masks.position[1 + i], 8 * beta / (n * (3 + 8 * beta)), closed_form) << n;
        EXPECT_NEAR(side.tangent1[1 + i], 2.0 / n * std::cos(2 * pi * i / n), closed_form) << n;
        EXPECT_NEAR(side.tangent2[1 + i], 2.0 / n * std::sin(2 * pi * i / n), closed_form) << n;
      }
    }
  }
}

TEST(LimitMasks, BilinearVerticesStay) {
  const Scheme<double> scheme = find_scheme("bilinear").value();
  for (int n = 3; n <= 8; ++n) {
    const LimitMasks masks = limit_masks(scheme, smooth_type(n, 4));
    EXPECT_EQ(masks.position, Eigen::VectorXd::Unit(2 * n + 1, 0));
  }
}

// Whole spectrum of the one-ring: block 0 has 1 and (3n - 7 +- sqrt(5 n^2 - 30 n + 49))/(8n), block k the two lambdas
// of c_k.
TEST(EigenStructure, CatmullClarkSpectrumMatchesTheClosedForm) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  for (int n = 3; n <= 50; ++n) {
    const auto fourier = fourier_blocks(local_step(scheme, smooth_type(n, 4)).matrix, n);
    ASSERT_TRUE(fourier.has_value()) << n;
    for (int k = 0; k < n; ++k) {
      std::vector<double> expected;
      if (k == 0) {
        const double root = std::sqrt(5.0 * n * n - 30 * n + 49);
        expected = {1, (3 * n - 7 + root) / (8 * n), (3 * n - 7 - root) / (8 * n)};
      } else {
        const double c = std::cos(2 * pi * k / n);
        expected = {catmull_clark_lambda(c, 1), catmull_clark_lambda(c, -1)};
      }
      std::vector<double> found;
      for (const EigenCluster& cluster : eigen_structure(fourier->blocks[k], k).clusters) {
        EXPECT_LE(std::abs(cluster.value.imag()), closed_form);
        for (int i = 0; i < cluster.multiplicity; ++i) found.push_back(cluster.value.real());
      }
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found.size(), expected.size());
      for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], closed_form) << n << " block " << k;
    }
  }
}

TEST(EigenStructure, LoopSpectrumMatchesTheClosedForm) {
  const Scheme<double> scheme = find_scheme("loop").value();
  for (int n = 3; n <= 50; ++n) {
    const auto fourier = fourier_blocks(local_step(scheme, smooth_type(n, 3)).matrix, n);
    ASSERT_TRUE(fourier.has_value()) << n;
    const double a = 3.0 / 8 + std::cos(2 * pi / n) / 4;
    const EigenStructure centre = eigen_structure(fourier->blocks[0]);
    EXPECT_NEAR(centre.clusters[0].value.real(), 1, closed_form);
    EXPECT_NEAR(centre.clusters[1].value.real(), a * a, closed_form) << n;  // 5/8 - beta
    for (int k = 1; k < n; ++k)
      EXPECT_NEAR(fourier->blocks[k](0, 0).real(), 3.0 / 8 + std::cos(2 * pi * k / n) / 4, closed_form) << n;
  }
}

// A smooth boundary vertex with m faces: {1, 1/2, 1/4}, the sine modes of the doubled valence, and for quads one 1/4
// more. Defective pairs (m = 1, 4 and 6) split by about sqrt(eps) in a general solver; sums of the spectrum do not.
TEST(EigenStructure, BoundarySpectraMatchTheClosedForm) {
  for (int m = 1; m <= 50; ++m) {
    for (const bool quads : {true, false}) {
      const Scheme<double> scheme = find_scheme(quads ? "catmull-clark" : "loop").value();
      std::vector<double> expected{1, 0.5, 0.25};
      if (quads) expected.push_back(0.25);
      for (int j = 1; j < m; ++j) {
        const double c = std::cos(pi * j / m);
        if (quads) {
          expected.push_back(catmull_clark_lambda(c, 1));
          expected.push_back(catmull_clark_lambda(c, -1));
        } else {
          expected.push_back(3.0 / 8 + c / 4);
        }
      }
      std::sort(expected.begin(), expected.end());
      const DenseMatrix<double> A = local_step(scheme, boundary_type(m, quads ? 4 : 3)).matrix;
      const std::vector<double> found = sorted_eigenvalues(A);
      ASSERT_EQ(found.size(), expected.size());
      double sum = 0;
      for (size_t i = 0; i < found.size(); ++i) {
        double gap = 1;  // to the nearest other eigenvalue
        for (size_t j = 0; j < expected.size(); ++j)
          if (j != i) gap = std::min(gap, std::abs(expected[j] - expected[i]));
        if (gap > 1e-3) {
          EXPECT_NEAR(found[i], expected[i], closed_form) << m;
        } else {
          EXPECT_NEAR(found[i], expected[i], 10 * std::sqrt(eps)) << m;
        }
        sum += found[i] - expected[i];
      }
      EXPECT_NEAR(sum, 0, closed_form * double(found.size())) << m;
    }
  }
}

// On a crease or boundary (1, 4, 1)/6; along it the difference of the two ends.
TEST(LimitMasks, BoundaryPositionAndTangentAreTheCubicBSplines) {
  for (int m = 1; m <= 50; ++m)
    for (const bool quads : {true, false}) {
      const Scheme<double> scheme = find_scheme(quads ? "catmull-clark" : "loop").value();
      const CanonicalNeighborhood type = boundary_type(m, quads ? 4 : 3);
      const LimitMasks masks = limit_masks(scheme, type);
      const Index first = type.fans[0].corners.front().slots[1], last = type.fans[0].corners.back().slots.back();
      Eigen::VectorXd position = Eigen::VectorXd::Zero(type.num_slots), along = position;
      position[0] = 4.0 / 6;
      position[first] = position[last] = 1.0 / 6;
      along[first] = 0.5;
      along[last] = -0.5;
      EXPECT_LE((masks.position - position).norm(), closed_form) << m;
      EXPECT_LE((masks.sides.at(0).tangent1 - along).norm(), closed_form) << m;
    }
}

// Regular boundary: across, Catmull-Clark 4 v + e_0 + e_2 - 4 e_1 - f_0 - f_1, Loop 2 v + v_0 + v_3 - 2 v_1 - 2 v_2,
// modulo the tangent along (which is antisymmetric, these are symmetric).
TEST(LimitMasks, RegularBoundaryCrossTangentsMatchTheClosedForm) {
  const LimitMasks quads = limit_masks(find_scheme("catmull-clark").value(), boundary_type(2, 4));
  const LimitMasks triangles = limit_masks(find_scheme("loop").value(), boundary_type(3, 3));
  Eigen::VectorXd q(6), t(5);
  q << -4, -1, 1, 4, 1, -1;  // slots: v, e0, f0, e1, f1, e2; inwards
  t << -2, -1, 2, 2, -1;     // v, v0, v1, v2, v3
  const auto across = [](const LimitMasks& masks) {
    const LimitMasks::Side& side = masks.sides.at(0);
    const Eigen::VectorXd along = side.tangent1.normalized();
    return Eigen::VectorXd((side.tangent2 - along * along.dot(side.tangent2)).normalized());
  };
  EXPECT_LE((across(quads) - q.normalized()).norm(), closed_form);
  EXPECT_LE((across(triangles) - t.normalized()).norm(), closed_form);
}

// By hand: with the plain rules the second sine mode decays faster than the tangent along the boundary up to 3
// quads and 5 triangles, equally at 4 and 6, slower beyond; corners fail from 3 quads and 4 triangles on.
TEST(LimitMasks, PlanesAtBoundariesAndCornersAreAsAnalysed) {
  using Plane = LimitMasks::Plane;
  for (int m = 1; m <= 12; ++m)
    for (const bool quads : {true, false}) {
      const Scheme<double> scheme = find_scheme(quads ? "catmull-clark" : "loop").value();
      CanonicalNeighborhood type = boundary_type(m, quads ? 4 : 3);
      const int jordan = quads ? 4 : 6, corner_jordan = quads ? 2 : 3;
      EXPECT_EQ(limit_masks(scheme, type).sides.at(0).plane, m < jordan    ? Plane::yes
                                                             : m == jordan ? Plane::slow
                                                                           : Plane::no)
          << m << (quads ? " quads" : " triangles");
      type.sharpness = infinite_sharpness;
      EXPECT_EQ(limit_masks(scheme, type).sides.at(0).plane, m < corner_jordan    ? Plane::yes
                                                             : m == corner_jordan ? Plane::slow
                                                                                  : Plane::no)
          << m << (quads ? " quads" : " triangles");
    }
}

TEST(LimitMasks, AreComputedOncePerType) {
  LimitCache cache(find_scheme("catmull-clark").value());
  const LimitMasks* first = &cache.masks(smooth_type(5, 4));
  EXPECT_EQ(first, &cache.masks(smooth_type(5, 4)));
  EXPECT_NE(first, &cache.masks(smooth_type(6, 4)));
  EXPECT_EQ(cache.num_types(), 2u);
}

// The start of the walk does not matter: a ring of mixed faces with one crease has one signature, whatever face comes
// first.
TEST(CanonicalNeighborhood, SignatureDoesNotDependOnNumbering) {
  const std::vector<Index> sizes{3, 5, 4, 4, 6};
  std::vector<std::uint32_t> signature;
  for (int shift = 0; shift < 5; ++shift) {
    Mesh mesh;
    std::vector<Index> starts;
    Index next = 1;
    std::vector<std::vector<Index>> faces(5);
    std::vector<Index> spoke(5);
    for (int i = 0; i < 5; ++i) spoke[i] = next++;
    for (int i = 0; i < 5; ++i) {
      faces[i] = {0, spoke[i]};
      for (Index k = 3; k < sizes[i]; ++k) faces[i].push_back(next++);
      faces[i].push_back(spoke[(i + 1) % 5]);
    }
    std::rotate(faces.begin(), faces.begin() + shift, faces.end());
    mesh.positions = Points::Random(next, 3);
    for (const auto& face : faces) {
      mesh.face_sizes.push_back(Index(face.size()));
      mesh.face_vertices.insert(mesh.face_vertices.end(), face.begin(), face.end());
    }
    mesh.creases = {{0, spoke[2], 1.5f}};
    const Topology t(view(mesh));
    const Sharpness sharpness = initial_sharpness(t, mesh, Boundary::edge_and_corner, Creasing::uniform);
    const NeighborhoodAt at = neighborhood(t, sharpness, Vertex{0});
    if (shift == 0) signature = at.type.signature();
    EXPECT_EQ(at.type.signature(), signature);
  }
}

}  // namespace
}  // namespace sublimit::testing

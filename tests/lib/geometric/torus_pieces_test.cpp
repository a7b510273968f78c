// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "meshes/irregular_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/geometric/torus_edge.h"
#include "sublimit/mesh/topology.h"
#include "support/tolerance.h"
#include "truth/deviation.h"

namespace sublimit::testing {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using std::numbers::pi;
const GeometricSurfaceScheme scheme = *find_geometric_scheme<CurvatureMesh>("torus-pieces");

/// What is promised of planes, spheres, cylinders and tori of size 1: positions, radians, curvatures (relative where
/// they are larger).
constexpr double reproduced = 1e-10;
/// Of meshes of size 1 that were moved, whose points are rounded before the first level.
constexpr double moved = 1e-12;

/// Outwards; tubes of radius r around a circle of radius R: a sphere if R = 0.
SurfacePoint on_torus(double R, double r, double phi, double t) {
  const Vector3d out(std::cos(phi), std::sin(phi), 0), up = Vector3d::UnitZ();
  const Vector3d normal = std::cos(t) * out + std::sin(t) * up;
  return {R * out + r * normal, normal, -1 / r, -std::cos(t) / (R + r * std::cos(t)),
          -std::sin(t) * out + std::cos(t) * up};
}
SurfacePoint on_torus_near(double R, double r, const Vector3d& x) {
  return on_torus(R, r, std::atan2(x[1], x[0]), std::atan2(x[2], std::hypot(x[0], x[1]) - R));
}
SurfacePoint on_cylinder_near(double r, const Vector3d& x) {
  const double phi = std::atan2(x[1], x[0]);
  const Vector3d out(std::cos(phi), std::sin(phi), 0);
  return {r * out + Vector3d(0, 0, x[2]), out, 0, -1 / r, Vector3d::UnitZ()};
}

using Surface = std::function<SurfacePoint(const Vector3d&)>;

/// The mesh with its vertices moved to the surface; some directions exchanged or reversed, as data have them.
CurvatureMesh data_on(const Surface& surface, const Mesh& mesh) {
  CurvatureMesh result;
  result.triangles = mesh.face_vertices;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    SurfacePoint p = surface(mesh.positions.row(v).transpose());
    if (v % 3 == 0) {
      p.direction1 = p.direction2();
      std::swap(p.k1, p.k2);
    }
    if (v % 2 == 0) p.direction1 = -p.direction1;
    result.points.push_back(p);
  }
  return result;
}

/// A grid over [0, 1]^2 with inner points moved aside, cut along random diagonals and mapped to space.
CurvatureMesh data_over(const std::function<SurfacePoint(double, double)>& surface, Index n, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  CurvatureMesh result;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double u = i + (inner ? shift(random) : 0), v = j + (inner ? shift(random) : 0);
      result.points.push_back(surface(u / n, v / n));
      if (i == n || j == n) continue;
      const Index a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      const std::array<Index, 6> cut = random() % 2 ? std::array{a, b, c, a, c, d} : std::array{a, b, d, b, c, d};
      result.triangles.insert(result.triangles.end(), cut.begin(), cut.end());
    }
  return result;
}

void expect_on(const Surface& surface, const CurvatureMesh& mesh, const std::string& what) {
  double position = 0, normal = 0, shape = 0;
  for (const SurfacePoint& p : mesh.points) {
    const SurfacePoint truth = surface(p.position);
    position = std::max(position, (p.position - truth.position).norm());
    normal = std::max(normal, (p.normal - truth.normal).norm());
    shape = std::max(shape, (p.shape() - truth.shape()).norm() / std::max(1.0, truth.shape().norm()));
  }
  EXPECT_LT(position, reproduced) << what;
  EXPECT_LT(normal, reproduced) << what;
  EXPECT_LT(shape, reproduced) << what;
}

void expect_reproduced(const Surface& surface, const CurvatureMesh& mesh, const std::string& what, int levels = 4) {
  CurvatureMesh fine = scheme.checked(mesh);
  EXPECT_TRUE(scheme.notes(fine).empty()) << what;
  for (int k = 1; k <= levels; ++k) {
    fine = scheme.refine(fine);
    expect_on(surface, fine, what + ", level " + std::to_string(k));
  }
}

TEST(TorusPieces, ReproduceTheSphere) {
  const Surface sphere = [](const Vector3d& x) { return on_torus_near(0, 1, x); };
  for (const auto& [name, mesh] : {std::pair("tetrahedron", tetrahedron()), std::pair("octahedron", octahedron()),
                                   std::pair("icosahedron", flipped(icosahedron(), 6))}) {
    CurvatureMesh data = data_on(sphere, mesh);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (SurfacePoint& p : data.points) {  // any directions are principal
      p.k1 = p.k2 = -1;
      const Vector3d any(normal(random), normal(random), normal(random));
      p.direction1 = p.normal.cross(any).normalized();
    }
    expect_reproduced(sphere, data, name);
  }
}

TEST(TorusPieces, ReproduceTheTorusAtAllLatitudes) {
  for (const double r : {0.3, 0.9}) {
    const Surface torus = [r](const Vector3d& x) { return on_torus_near(1, r, x); };
    CurvatureMesh data = data_on(torus, flipped(triangle_torus(9, 7), 20));
    for (Index v = 0; v < data.num_vertices(); ++v)
      data.points[v] = on_torus(1, r, 2 * pi * (v / 7 + 0.1 * (v % 5)) / 9, 2 * pi * (v % 7 + 0.1 * (v % 4)) / 7);
    expect_reproduced(torus, data, "r " + std::to_string(r));
  }
}

/// Random tori, spindles left out, at random places, five levels. SUBLIMIT_FULL: a hundred.
TEST(TorusPieces, ReproduceRandomTori) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  const int count = std::getenv("SUBLIMIT_FULL") != nullptr ? 100 : 2;
  for (int i = 0; i < count; ++i) {
    const double r = 0.2 + 0.7 * any(random), phi = any(random), t = 2 * pi * any(random), width = 0.1 + any(random);
    const CurvatureMesh data =
        data_over([&](double u, double v) { return on_torus(1, r, phi + width * u, t + 2 * width * v); }, 3, i + 1);
    const CurvatureMesh fine = refine(scheme, data, 5);
    expect_on([r](const Vector3d& x) { return on_torus_near(1, r, x); }, fine, "torus " + std::to_string(i));
  }
}

TEST(TorusPieces, ReproduceCylinderAndPlane) {
  const Surface cylinder = [](const Vector3d& x) { return on_cylinder_near(0.5, x); };
  expect_reproduced(cylinder,
                    data_over(
                        [&](double u, double v) {
                          return cylinder({std::cos(4 * u), std::sin(4 * u), v});
                        },
                        5),
                    "cylinder");
  const Surface plane = [](const Vector3d& x) {
    return SurfacePoint{{x[0], x[1], 0}, Vector3d::UnitZ(), 0, 0, Vector3d::UnitX()};
  };
  expect_reproduced(plane, data_over([&](double u, double v) { return plane({u, v, 0}); }, 5), "plane");
}

/// z = sin x cos y over a jittered grid, elliptic and hyperbolic.
const ImplicitSurface wave{[](const Vector3d& x) {
  const double sx = std::sin(x[0]), cx = std::cos(x[0]), sy = std::sin(x[1]), cy = std::cos(x[1]);
  ImplicitSurface::Jet jet{.value = x[2] - sx * cy, .gradient = {-cx * cy, sx * sy, 1}};
  jet.hessian(0, 0) = jet.hessian(1, 1) = sx * cy;
  jet.hessian(0, 1) = jet.hessian(1, 0) = cx * sy;
  return jet;
}};
CurvatureMesh wave_data(Index n = 5, unsigned seed = 1) {
  return data_over(
      [](double u, double v) {
        return nearest_point(wave, {3 * u, 3 * v, std::sin(3 * u) * std::cos(3 * v)});
      },
      n, seed);
}

/// The largest difference of positions, normals and shapes; the mesh's size is about 1.
double difference(const CurvatureMesh& a, const CurvatureMesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  double largest = 0;
  for (Index v = 0; v < a.num_vertices(); ++v)
    largest = std::max({largest, (a.points[v].position - b.points[v].position).norm(),
                        (a.points[v].normal - b.points[v].normal).norm(),
                        (a.points[v].shape() - b.points[v].shape()).norm()});
  return largest;
}

TEST(TorusPieces, KeepGivenDataBitwise) {
  const CurvatureMesh data = scheme.checked(wave_data());
  for (const char* cut : {"regular", "perimeter"}) {
    const GeometricSurfaceScheme same = *find_geometric_scheme<CurvatureMesh>("torus-pieces", {{"cut", cut}});
    const CurvatureMesh fine = refine(same, data, 3);
    ASSERT_GT(fine.num_vertices(), data.num_vertices());
    EXPECT_EQ(difference(fine, refine(same, refine(same, data, 2), 1)), 0);
    for (Index v = 0; v < fine.num_vertices(); ++v) {
      EXPECT_EQ(fine.original[v], v < data.num_vertices());
      if (!fine.original[v]) continue;
      const SurfacePoint &a = data.points[v], &b = fine.points[v];
      EXPECT_TRUE(a.position == b.position && a.normal == b.normal && a.direction1 == b.direction1 && a.k1 == b.k1 &&
                  a.k2 == b.k2);
    }
    EXPECT_TRUE(Topology(view(fine)).is_manifold());
    EXPECT_TRUE(Topology(view(fine)).faults().empty());
  }
}

TEST(TorusPieces, DoNotDependOnPlaceSizeSideOrOrder) {
  const CurvatureMesh data = wave_data(), fine = refine(scheme, data, 2);
  const Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const double size = 7;
  const auto map = [&](CurvatureMesh mesh) {
    for (SurfacePoint& p : mesh.points)
      p = {size * (R * p.position) + Vector3d(3, 1, 4), R * p.normal, p.k1 / size, p.k2 / size, R * p.direction1};
    return mesh;
  };
  EXPECT_LT(difference(refine(scheme, map(data), 2), map(fine)), size * moved);
  const auto scale = [](CurvatureMesh mesh, double by) {  // by powers of 2, exactly
    for (SurfacePoint& p : mesh.points) p = {by * p.position, p.normal, p.k1 / by, p.k2 / by, p.direction1};
    return mesh;
  };
  for (const double by : {0x1p-600, 0x1p600})
    EXPECT_EQ(difference(scale(refine(scheme, scale(data, by), 2), 1 / by), fine), 0);
  const auto flip = [](CurvatureMesh mesh) {
    for (SurfacePoint& p : mesh.points) p = p.flipped();
    return mesh;
  };
  EXPECT_LT(difference(refine(scheme, flip(data), 2), flip(fine)), moved);
  const auto exchange = [](CurvatureMesh mesh) {  // the same second form, told in the other order
    for (SurfacePoint& p : mesh.points) {
      p.direction1 = -p.direction2();
      std::swap(p.k1, p.k2);
    }
    return mesh;
  };
  EXPECT_LT(difference(refine(scheme, exchange(data), 2), fine), moved);
}

TEST(TorusPieces, DoNotDependOnTheDirectionOfAnEdge) {
  const CurvatureMesh data = wave_data();
  for (Index f = 0; f < data.num_faces(); ++f) {
    const SurfacePoint &a = data.points[data.triangles[3 * f]], &b = data.points[data.triangles[3 * f + 1]],
                       &c = data.points[data.triangles[3 * f + 2]], &d = data.points[0];
    const std::array<const SurfacePoint*, 2> one{&c, &d}, other{&d, &c};
    const SurfacePoint x = torus_edge(a, b, one).point, y = torus_edge(b, a, other).point;
    EXPECT_LT((x.position - y.position).norm() + (x.normal - y.normal).norm() + (x.shape() - y.shape()).norm(), moved);
  }
}

/// Two ends that lie on two tori: the equator of one is the tube of the other. The opposite corners decide.
TEST(TorusPieces, OppositeCornersTellTwoToriApart) {
  const SurfacePoint a = on_torus(2, 1, 0, 0), b = on_torus(2, 1, 0.5, 0);
  for (const double t : {0.4, -0.7}) {
    const SurfacePoint c = on_torus(2, 1, 0.2, t);
    const std::array<const SurfacePoint*, 1> corner{&c};
    const SurfacePoint middle = torus_edge(a, b, corner).point, truth = on_torus(2, 1, 0.25, 0);
    EXPECT_LT((middle.shape() - truth.shape()).norm(), reproduced);
  }
}

TEST(TorusPieces, FallBackToTheChord) {
  const SurfacePoint a{.position = {0, 0, 0}}, along_normal{.position = {0, 0, 1}},
      opposite{.position = {1, 0, 0}, .normal = -Vector3d::UnitZ()}, side{.position = {0, 1, 0}};
  const std::array<const SurfacePoint*, 1> corner{&side};
  for (const SurfacePoint& b : {a, along_normal, opposite}) {
    const EdgePoint middle = torus_edge(a, b, corner);
    EXPECT_TRUE(middle.fell_back);
    EXPECT_EQ(middle.point.position, (a.position + b.position) / 2);
    EXPECT_EQ(middle.point.normal, Vector3d::UnitZ());
    EXPECT_EQ(middle.point.k1, 0);
    EXPECT_EQ(middle.point.k2, 0);
  }
  CurvatureMesh mesh{.triangles = {0, 1, 2}, .points = {a, opposite, side}};
  const std::vector<std::string> notes = scheme.notes(scheme.checked(mesh));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("2 of 3 edges"), std::string::npos) << notes[0];
  for (const SurfacePoint& p : refine(scheme, mesh, 3).points)
    EXPECT_TRUE(p.position.allFinite() && p.normal.allFinite());
}

/// Data of no surface at all: whatever comes is finite, fit for the next level, and not far away.
TEST(TorusPieces, StayNearWithoutSense) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 60; ++i) {
    const double bend = std::pow(10.0, i % 13 - 6);
    CurvatureMesh data{.triangles = tetrahedron().face_vertices, .points = {}};
    for (Index v = 0; v < 4; ++v) {
      const Vector3d n = any().normalized(), d = n.unitOrthogonal();
      data.points.push_back({any(), n, bend * normal(random), i % 4 == 0 ? 0 : bend * normal(random), d});
      if (i % 5 == 0) data.points[v].position = data.points[0].position + 1e-9 * any();
    }
    const CurvatureMesh fine = refine(scheme, data, 3);
    EXPECT_NO_THROW(scheme.checked(fine));
    for (const SurfacePoint& p : fine.points) EXPECT_LT(p.position.norm(), 50);
  }
}

TEST(TorusPieces, CutAlongTheDiagonalOfEqualPerimeters) {
  // Far from similar triangles: the curved edges make the hexagon lopsided.
  const GeometricSurfaceScheme other = *find_geometric_scheme<CurvatureMesh>("torus-pieces", {{"cut", "perimeter"}});
  const CurvatureMesh data = wave_data(3), regular = refine(scheme, data, 1), cut = refine(other, data, 1);
  EXPECT_NE(regular.triangles, cut.triangles);
  const CurvatureMesh flat = data_over([](double u, double v) { return SurfacePoint{.position = {u, v, 0}}; }, 3);
  EXPECT_EQ(difference(refine(scheme, flat, 2), refine(other, flat, 2)), 0);
}

/// In a plane, up to squares, the rule is linear but for the weights of the carriers. The difference that one vertex
/// makes to second derivatives does not grow from level to level; with quintic weights, or with directions across at
/// right angles to the edges, it would.
TEST(TorusPieces, DoNotAmplifySecondDerivativesOnLattices) {
  for (const Vector3d& shear : {Vector3d(0, 1, 0), Vector3d(-0.5, 0.9, 0), Vector3d(-0.3, 0.5, 0)}) {
    const Index n = 2;
    const Mesh lattice = triangle_grid(n, n);
    CurvatureMesh data{.triangles = lattice.face_vertices, .points = {}};
    for (Index v = 0; v < lattice.num_vertices(); ++v)
      data.points.push_back({.position = (v % (n + 1)) * Vector3d::UnitX() + (v / (n + 1)) * shear});
    data.points[(n + 2) * (n / 2)].k1 = 1e-6;
    std::vector<double> jumps;
    for (CurvatureMesh fine = scheme.checked(data); jumps.size() < 6; fine = scheme.refine(fine)) {
      jumps.push_back(0);
      for (size_t i = 0; i < fine.triangles.size(); ++i) {
        const size_t j = i % 3 == 2 ? i - 2 : i + 1;
        jumps.back() = std::max(
            jumps.back(), (fine.points[fine.triangles[i]].shape() - fine.points[fine.triangles[j]].shape()).norm());
      }
    }
    EXPECT_LT(jumps[5], jumps[3]) << shear.transpose();
  }
}

}  // namespace
}  // namespace sublimit::testing

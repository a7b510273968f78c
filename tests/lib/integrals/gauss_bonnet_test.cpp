// SPDX-License-Identifier: Apache-2.0
// Gauss and Bonnet: the total curvature of a surface, with what its border and its corners turn by, is 2 pi times its
// Euler characteristic. First and second derivatives, in all places at once.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/source/curvature.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

/// Of the total curvature: rules of 8 x 8 nodes are exact for no rational function.
constexpr double curvature_tolerance = 1e-6;
/// Around a vertex curvature may grow by mu / lambda^2 from ring to ring while areas shrink by lambda^2: at valence 8
/// the rings that are left out still have this.
constexpr double tolerance_at_eight = 1e-4;

/// Rules on rings that halve towards all corners of a square or triangle, where curvature may be unbounded.
std::vector<QuadraturePoint> rules_towards_corners(bool triangles) {
  constexpr int rings = 16, nodes = 8;
  std::vector<QuadraturePoint> rule;
  double size = triangles ? 0.5 : 0.25;
  const auto add_triangle = [&](const std::array<Eigen::Vector2d, 3>& corners) {
    const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
    for (const QuadraturePoint& p : triangle_rule(nodes)) {
      const Eigen::Vector2d x = corners[0] + p.u * a + p.v * b;
      rule.push_back({x[0], x[1], p.weight * std::abs(a[0] * b[1] - a[1] * b[0])});
    }
  };
  const std::array<Eigen::Vector2d, 3> outer{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
  if (triangles) add_triangle({(outer[0] + outer[1]) / 2, (outer[1] + outer[2]) / 2, (outer[2] + outer[0]) / 2});
  for (int ring = 0; ring < rings; ++ring, size /= 2) {
    if (triangles) {
      for (size_t c = 0; c < 3; ++c) {  // from the corner, the triangle of this size less that of half the size
        const Eigen::Vector2d a = size * (outer[(c + 1) % 3] - outer[c]), b = size * (outer[(c + 2) % 3] - outer[c]);
        add_triangle({outer[c] + a / 2, outer[c] + a, outer[c] + (a + b) / 2});
        add_triangle({outer[c] + b / 2, outer[c] + b, outer[c] + (a + b) / 2});
        add_triangle({outer[c] + a / 2, outer[c] + b / 2, outer[c] + (a + b) / 2});
      }
      continue;
    }
    for (const auto& [i, j] : {std::pair{1, 0}, {0, 1}, {1, 1}})
      for (const QuadraturePoint& p : square_rule(nodes)) {
        const double u = size * (i + p.u), v = size * (j + p.v), weight = p.weight * size * size;
        for (const double a : {u, 1 - u})
          for (const double b : {v, 1 - v}) rule.push_back({a, b, weight});
      }
  }
  return rule;
}

double total_curvature(const LimitMap& surface, const Points& points) {
  std::vector<Place> samples;
  std::vector<double> weights;
  for (Index f = 0; f < surface.addresses().size(); ++f)
    for (const QuadraturePoint& p : rules_towards_corners(surface.addresses().triangles())) {
      samples.push_back({f, p.u, p.v});
      weights.push_back(p.weight);
    }
  const LimitSamples at = surface.evaluate(points, samples, 2);
  double sum = 0;
  for (Index i = 0; i < Index(samples.size()); ++i) {
    const Eigen::Vector3d u = at.du.row(i), v = at.dv.row(i);
    if (const std::optional<Curvature> K = curvature(at, i)) sum += weights[size_t(i)] * K->gauss * u.cross(v).norm();
  }
  return sum;
}

/// Normals are continuous where curvature is not, so vertices and seams add nothing.
TEST(GaussBonnet, TotalCurvatureOfClosedLimitsIsTwoPiChi) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin"}) {
    SCOPED_TRACE(name);
    const Scheme<double> scheme = *find_scheme<double>(name);
    const bool triangles = takes_triangles(scheme);
    const Mesh ball = jittered(triangles ? octahedron() : cube(), 0.2);
    const Mesh ring = jittered(triangles ? triangle_torus(6, 5) : torus(6, 5), 0.1);
    for (const auto& [mesh, chi] : {std::pair{ball, 2}, std::pair{ring, 0}})
      EXPECT_NEAR(total_curvature(LimitMap(scheme, mesh), mesh.positions), 2 * std::numbers::pi * chi,
                  curvature_tolerance);
  }
}

TEST(GaussBonnet, TotalCurvatureAroundExtraordinaryVerticesIsTwoPiChi) {
  struct Case {
    const char* scheme;
    Mesh mesh;
    double tolerance;
  };
  for (const Case& c :
       {Case{"catmull-clark", prism(5), curvature_tolerance}, Case{"loop", icosahedron(), curvature_tolerance},
        Case{"catmull-clark", pole(8), tolerance_at_eight}}) {
    const Mesh mesh = jittered(c.mesh, 0.1);
    EXPECT_NEAR(total_curvature(LimitMap(*find_scheme<double>(c.scheme), mesh), mesh.positions), 4 * std::numbers::pi,
                c.tolerance)
        << c.scheme;
  }
}

/// What the border turns by, to the left where the surface is, along its edges and at their ends.
double turning_of_border(const LimitMap& surface, const Points& points) {
  const Topology& t = surface.level().topology();
  struct Frame {
    Eigen::Vector3d T, along_T, normal;  ///< first and second derivative along the edge
  };
  const auto frame = [&](HalfEdge h, double s) -> Frame {
    const Place at = on_edge(t, surface.addresses(), h, s), begin = on_edge(t, surface.addresses(), h, 0),
                end = on_edge(t, surface.addresses(), h, 1);
    const double u = end.u - begin.u, v = end.v - begin.v;
    const LimitSamples x = surface.evaluate(points, std::vector<Place>{at}, 2);
    return {u * x.du.row(0) + v * x.dv.row(0), u * u * x.duu.row(0) + 2 * u * v * x.duv.row(0) + v * v * x.dvv.row(0),
            x.normal.row(0)};
  };
  double sum = 0;
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i};
    if (exists(t.twin(h))) continue;
    for (const QuadraturePoint& p : square_rule(12)) {
      const Frame x = frame(h, p.u);
      sum += p.weight * x.normal.cross(x.T).dot(x.along_T) / x.T.squaredNorm();
    }
    HalfEdge next = t.next(h);
    while (exists(t.twin(next))) next = t.next(t.twin(next));
    const Frame in = frame(h, 1), out = frame(next, 0);
    sum += std::atan2(in.normal.dot(in.T.cross(out.T)), in.T.dot(out.T));
  }
  return sum;
}

TEST(GaussBonnet, BordersAndCornersTurnByWhatCurvatureLeaves) {
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  for (const Mesh& mesh : {jittered(grid(3, 2), 0.2), jittered(fan(5, 4, 2), 0.1)}) {
    const LimitMap surface(scheme, mesh);
    const double curvature = total_curvature(surface, mesh.positions);
    EXPECT_NEAR(curvature + turning_of_border(surface, mesh.positions), 2 * std::numbers::pi, curvature_tolerance);
    EXPECT_GE(std::abs(curvature), 0.1);
  }
}

}  // namespace
}  // namespace sublimit::testing

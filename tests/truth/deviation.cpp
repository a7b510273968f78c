// SPDX-License-Identifier: Apache-2.0
#include "truth/deviation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/topology.h"

namespace sublimit::testing {
namespace {

using Eigen::Matrix3d, Eigen::Matrix4d, Eigen::Vector3d, Eigen::Vector4d;

constexpr int newton_steps = 50;
constexpr double newton_rounding = 1e-15;  // of a step, relative to the coordinates

/// Angle between vectors, exact for small ones.
double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

class Sum {
 public:
  void add(double x) {
    largest_ = std::max(largest_, std::abs(x));
    squares_ += x * x;
    ++count_;
  }
  Spread spread() const { return {largest_, count_ > 0 ? std::sqrt(squares_ / count_) : 0}; }

 private:
  double largest_ = 0, squares_ = 0;
  int count_ = 0;
};

void measure_vertices(const CurvatureMesh& mesh, const ImplicitSurface& surface, Deviation& result) {
  Sum position, normal, k1, k2;
  for (const SurfacePoint& p : mesh.points) {
    const SurfacePoint truth = nearest_point(surface, p.position);
    position.add((p.position - truth.position).norm());
    normal.add(angle(p.normal, truth.normal));
    k1.add(std::max(p.k1, p.k2) - std::max(truth.k1, truth.k2));
    k2.add(std::min(p.k1, p.k2) - std::min(truth.k1, truth.k2));
  }
  result.position = position.spread();
  result.normal = normal.spread();
  result.k1 = k1.spread();
  result.k2 = k2.spread();
}

void measure_triangles(const CurvatureMesh& mesh, Deviation& result) {
  const Topology topology(view(mesh));
  const auto at = [&](Vertex v) -> const SurfacePoint& { return mesh.points[index(v)]; };
  std::vector<Vector3d> normals(mesh.num_faces()), centroids(mesh.num_faces());
  Sum triangle, neighbours, bend;
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const std::span<const Index> v = topology.vertices(Face{f});
    const Vector3d a = mesh.points[v[0]].position, b = mesh.points[v[1]].position, c = mesh.points[v[2]].position;
    normals[f] = (b - a).cross(c - a);
    centroids[f] = (a + b + c) / 3;
    for (const Index i : v) triangle.add(angle(normals[f], mesh.points[i].normal));
  }
  for (Index e = 0; e < topology.num_edges(); ++e) {
    result.edge =
        std::max(result.edge, (at(topology.tail(Edge{e})).position - at(topology.head(Edge{e})).position).norm());
    const HalfEdge h = topology.half_edge(Edge{e}), twin = topology.twin(h);
    if (!exists(twin)) continue;
    const Index f = index(topology.face(h)), g = index(topology.face(twin));
    const double turn = angle(normals[f], normals[g]);
    neighbours.add(turn);
    bend.add(turn / (centroids[f] - centroids[g]).norm());
  }
  result.triangle = triangle.spread();
  result.neighbours = neighbours.spread();
  result.bend = bend.spread();
}

}  // namespace

SurfacePoint nearest_point(const ImplicitSurface& surface, const Vector3d& x) {
  // y + multiplier * gradient = x, f(y) = 0.
  Vector3d y = x;
  ImplicitSurface::Jet jet = surface.at(y);
  double multiplier = jet.value / jet.gradient.squaredNorm();
  y -= multiplier * jet.gradient;
  for (int step = 0;; ++step) {
    jet = surface.at(y);
    Matrix4d J;
    J << Matrix3d::Identity() + multiplier * jet.hessian, jet.gradient, jet.gradient.transpose(), 0;
    Vector4d residual;
    residual << y + multiplier * jet.gradient - x, jet.value;
    const Vector4d change = J.partialPivLu().solve(residual);
    y -= change.head<3>();
    multiplier -= change[3];
    if (change.head<3>().norm() <= newton_rounding * (1 + x.norm())) break;
    if (step == newton_steps || !y.allFinite()) {
      if (y.allFinite() && change.head<3>().norm() <= 1e3 * newton_rounding * (1 + x.norm())) break;
      throw InvalidParameter("no nearest point of the surface is found for (" + format_number(x[0]) + ", " +
                             format_number(x[1]) + ", " + format_number(x[2]) + "); it is too far away");
    }
  }
  jet = surface.at(y);
  const double length = jet.gradient.norm();
  return surface_point(y, jet.gradient / length, -jet.hessian / length);
}

std::vector<Deviation> deviations(const GeometricScheme<CurvatureMesh>& scheme, const CurvatureMesh& mesh, int levels,
                                  const ImplicitSurface& surface) {
  if (levels < 0) throw InvalidParameter("levels is " + format_number(levels) + "; it must be 0 or more");
  std::vector<Deviation> table;
  CurvatureMesh data = scheme.checked(mesh);
  for (int k = 0; k <= levels; ++k) {
    if (k > 0) data = scheme.refine(data);
    Deviation& row = table.emplace_back();
    row.level = k;
    row.vertices = data.num_vertices();
    measure_vertices(data, surface, row);
    measure_triangles(data, row);
  }
  return table;
}

std::vector<VertexTarget> targets_on(const ImplicitSurface& surface, const Mesh& mesh) {
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const SurfacePoint p = nearest_point(surface, mesh.positions.row(v).transpose());
    targets.push_back({v, p.position, p.normal, TargetCurvature{p.k1, p.k2, p.direction1}});
  }
  return targets;
}

}  // namespace sublimit::testing

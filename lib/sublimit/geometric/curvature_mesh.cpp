// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/curvature_mesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;
constexpr double eps = std::numeric_limits<double>::epsilon();

std::string at(Index v) { return "vertex " + format_number(v) + ": "; }

Vector3d unit(const Vector3d& x, Index v, const char* what) {
  if (!x.allFinite()) throw InvalidMesh(at(v) + "its " + what + " is not finite; numbers are needed");
  const double largest = x.cwiseAbs().maxCoeff();
  if (largest == 0) throw InvalidMesh(at(v) + "its " + what + " has length 0; any other length will do");
  return (x / largest).normalized();
}

SurfacePoint point_of(const VertexTarget& target) {
  const Index v = target.vertex;
  if (!target.normal)
    throw InvalidMesh(at(v) + "it has no normal; torus pieces need a normal and curvatures everywhere");
  if (!target.curvature)
    throw InvalidMesh(at(v) + "it has no curvatures; torus pieces need k1, k2 and the direction of k1 everywhere");
  return {target.position, unit(*target.normal, v, "normal"), target.curvature->k1, target.curvature->k2,
          unit(target.curvature->direction1, v, "direction")};
}

void make_exact(SurfacePoint& point, Index v) {
  if (!point.position.allFinite()) throw InvalidMesh(at(v) + "its position is not finite; numbers are needed");
  if (!std::isfinite(point.k1) || !std::isfinite(point.k2))
    throw InvalidMesh(at(v) + "its curvatures are not finite; a plane has curvatures 0");
  for (Vector3d* x : {&point.normal, &point.direction1}) {
    const char* what = x == &point.normal ? "normal" : "direction";
    const Vector3d direction = unit(*x, v, what);
    const double length = x->stableNorm();
    if (std::abs(length - 1) > unit_tolerance)
      throw InvalidMesh(at(v) + "its " + what + " has length " + format_number(length) + "; it must be 1");
    if (std::abs(length - 1) > 4 * eps) *x = direction;
  }
  const double lean = point.direction1.dot(point.normal), angle = std::asin(std::min(1.0, std::abs(lean)));
  if (angle > direction_tolerance)
    throw InvalidMesh(at(v) + "its direction of k1 leaves the tangent plane by " + format_number(angle) +
                      " radians; it must be at right angles to the normal, up to " +
                      format_number(direction_tolerance));
  if (angle > 4 * eps) point.direction1 = (point.direction1 - lean * point.normal).normalized();
}

}  // namespace

CurvatureMesh checked(CurvatureMesh mesh) {
  if (mesh.triangles.empty()) throw InvalidMesh("there are no faces; torus pieces need triangles");
  if (mesh.triangles.size() % 3 != 0)
    throw InvalidMesh(format_number(mesh.triangles.size()) + " corners are no whole number of triangles");
  if (!mesh.original.empty() && mesh.original.size() != mesh.points.size())
    throw InvalidMesh("`original` has " + format_number(mesh.original.size()) + " entries for " +
                      format_number(mesh.points.size()) + " vertices; it has one each, or none at all");
  const Topology topology(view(mesh));
  if (!topology.faults().empty())
    throw UnsupportedTopology(topology.faults().front().message +
                              "; torus pieces take manifolds, with borders or without");
  for (Index v = 0; v < mesh.num_vertices(); ++v) make_exact(mesh.points[v], v);
  return mesh;
}

CurvatureMesh curvature_mesh(const Mesh& mesh, std::span<const VertexTarget> targets) {
  CurvatureMesh result;
  result.points.resize(mesh.num_vertices());
  std::vector<bool> found(mesh.num_vertices());
  for (const VertexTarget& target : targets) {
    if (target.vertex < 0 || target.vertex >= mesh.num_vertices())
      throw InvalidMesh("a target is for vertex " + format_number(target.vertex) + "; there are vertices 0 to " +
                        format_number(mesh.num_vertices() - 1));
    if (found[target.vertex]) throw InvalidMesh(at(target.vertex) + "it has several targets; leave one");
    found[target.vertex] = true;
    result.points[target.vertex] = point_of(target);
  }
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    if (!found[v])
      throw InvalidMesh(at(v) + "it has no target; torus pieces need point, normal and curvatures everywhere");
  const Topology topology(view(mesh));  // indices in range, before they are used
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const std::span<const Index> v = topology.vertices(Face{f});
    if (v.size() > 4)
      throw UnsupportedTopology("face " + format_number(f) + " has " + format_number(v.size()) +
                                " corners; torus pieces take triangles, and quads, which they cut in two");
    const auto distance = [&](int i, int j) {
      return (result.points[v[i]].position - result.points[v[j]].position).squaredNorm();
    };
    if (v.size() == 3)
      result.triangles.insert(result.triangles.end(), {v[0], v[1], v[2]});
    else if (distance(1, 3) < distance(0, 2))
      result.triangles.insert(result.triangles.end(), {v[0], v[1], v[3], v[1], v[2], v[3]});
    else
      result.triangles.insert(result.triangles.end(), {v[0], v[1], v[2], v[0], v[2], v[3]});
  }
  return checked(std::move(result));
}

Mesh control_mesh(const CurvatureMesh& mesh) {
  Mesh result;
  result.positions.resize(mesh.num_vertices(), 3);
  for (Index v = 0; v < mesh.num_vertices(); ++v) result.positions.row(v) = mesh.points[v].position;
  result.face_sizes.assign(mesh.num_faces(), 3);
  result.face_vertices = mesh.triangles;
  return result;
}

}  // namespace sublimit

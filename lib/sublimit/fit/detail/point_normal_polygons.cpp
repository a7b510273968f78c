// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/point_normal_polygons.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/plane_polygon.h"
#include "sublimit/fit/detail/vertex_limits.h"
#include "sublimit/limit/detail/limit_rows.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// Weights below this are rounding: limits do not depend on such points.
constexpr double least_weight = 1e-14;

/// A face that carries a target.
struct Carrier {
  size_t target = 0;
  Centre centre;
  LimitRows rows;
};

std::string at(const VertexTarget& target) { return "vertex " + std::to_string(target.vertex); }

void check(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<VertexTarget>& targets,
           const PolygonOptions& options) {
  if (!scheme.is_dual())
    throw InvalidParameter(scheme.name + ": its vertices do not become faces; interpolate points and normals instead");
  if (!(options.size > 0 && options.size < 1))
    throw InvalidParameter("size " + format_number(options.size) + " of polygons is not between 0 and 1");
  if (mesh.positions.cols() != 3)
    throw InvalidMesh("points need 3 coordinates, not " + std::to_string(mesh.positions.cols()));
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    if (!mesh.positions.row(v).allFinite())
      throw InvalidMesh("vertex " + std::to_string(v) + ": its position is not finite; give a first guess");
  std::vector<bool> seen(mesh.num_vertices(), false);
  for (const VertexTarget& target : targets) {
    if (target.vertex < 0 || target.vertex >= mesh.num_vertices())
      throw InvalidParameter(at(target) + " of a target: the mesh has vertices 0 to " +
                             std::to_string(mesh.num_vertices() - 1));
    if (seen[target.vertex]) throw InvalidParameter(at(target) + " has two targets");
    seen[target.vertex] = true;
    if (!target.position.allFinite()) throw InvalidParameter(at(target) + ": the target's position is not finite");
    if (target.normal && !target.normal->allFinite())
      throw InvalidParameter(at(target) + ": the target's normal is not finite");
    if (target.normal && target.normal->isZero(0)) throw InvalidParameter(at(target) + ": the normal has no length");
    if (target.curvature)
      throw InvalidParameter(at(target) + ": a plane face cannot be given curvatures; give position and normal only");
  }
}

/// The faces that vertices have become; several where sheets meet in a vertex.
std::vector<Carrier> carriers(const std::vector<Level>& levels, const std::vector<VertexTarget>& targets) {
  const Topology& control = levels[0].topology();
  std::vector<Carrier> all;
  for (size_t i = 0; i < targets.size(); ++i) {
    const Vertex v{targets[i].vertex};
    if (control.is_isolated(v))
      throw InvalidParameter(at(targets[i]) + " is isolated: it has no surface to pass through");
    for (const HalfEdge start : control.fans(v)) {
      // Two faces glued along two edges leave no room for a face between.
      const bool closed = exists(control.twin(start));
      if (closed && (control.ccw(start) == start || control.ccw(control.ccw(start)) == start))
        throw UnsupportedTopology(at(targets[i]) + " lies between two faces only: it does not become a face");
      all.push_back({i, descendant({Centre::Kind::vertex, start}, levels), {}});
    }
  }
  return all;
}

Vector3d applied(LimitRows::Row row, const Points& points, const Vector3d& origin) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& [column, weight] : row) sum += weight * (points.row(column).transpose() - origin);
  return sum;
}

/// Moves vertices by what their limits lack, so that polygons are as large as the data are far apart, and refines.
Points guessed(const SparseMatrix& P, Points control, const std::vector<Carrier>& all,
               const std::vector<VertexTarget>& targets) {
  const Points refined = apply(P, control);
  std::vector<int> sheets(targets.size(), 0);
  for (const Carrier& carrier : all) ++sheets[carrier.target];
  for (const Carrier& carrier : all) {
    const VertexTarget& target = targets[carrier.target];
    control.row(target.vertex) -=
        applied(carrier.rows.position(), refined, target.position).transpose() / sheets[carrier.target];
  }
  return apply(P, control);
}

/// The face of a carrier with the weights of its rows.
/// @throws UnsupportedTopology  rows that need more points than these, no tangent plane for a normal
PlanePolygon polygon_of(const Scheme<double>& scheme, const Carrier& carrier, const VertexTarget& target,
                        std::span<const Index> corners, const Points& points) {
  if (target.normal && carrier.rows.status == LimitStatus::undefined_normal)
    throw UnsupportedTopology(at(target) + ": the limit has no tangent plane there under " + scheme.name +
                              "; give its position only");
  const Eigen::Index n = Eigen::Index(corners.size());
  PlanePolygon polygon{.corners = Eigen::MatrixX3d(n, 3), .weights = Eigen::MatrixX3d::Zero(n, 3)};
  for (Eigen::Index i = 0; i < n; ++i) polygon.corners.row(i) = points.row(corners[size_t(i)]);
  int column = 0;
  for (const LimitRows::Row row : {carrier.rows.position(), carrier.rows.tangent1(), carrier.rows.tangent2()}) {
    if (column > 0 && !target.normal) break;
    for (const auto& [vertex, weight] : row) {
      const auto found = std::find(corners.begin(), corners.end(), vertex);
      if (found != corners.end()) {
        polygon.weights(found - corners.begin(), column) += weight;
      } else if (std::abs(weight) > least_weight) {
        throw UnsupportedTopology(at(target) + ": its " + (column == 0 ? "limit" : "normal") +
                                  " depends on more than the points of its own face under " + scheme.name +
                                  "; interpolate points and normals instead");
      }
    }
    ++column;
  }
  return polygon;
}

/// Between a normal, which may be none, and the one that it should be.
double angle(const Vector3d& a, const Vector3d& b) {
  return a.isZero(0) ? std::numbers::pi : std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Residuals by the limit's own rows.
void measure(PointNormalMesh& result, const std::vector<Carrier>& all, const std::vector<VertexTarget>& targets) {
  const Eigen::Index count = Eigen::Index(targets.size());
  result.position_residual = Eigen::VectorXd::Zero(count);
  result.normal_residual = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  for (const Carrier& carrier : all) {
    const VertexTarget& target = targets[carrier.target];
    const auto from_target = [&](LimitRows::Row row) { return applied(row, result.points, target.position); };
    double& distance = result.position_residual[Eigen::Index(carrier.target)];
    distance = std::max(distance, from_target(carrier.rows.position()).norm());
    if (!target.normal) continue;
    const Vector3d normal = from_target(carrier.rows.tangent1()).cross(from_target(carrier.rows.tangent2()));
    const double turned = angle(normal, target.normal->stableNormalized() * normal.norm());
    double& most = result.normal_residual[Eigen::Index(carrier.target)];
    most = std::isnan(most) ? turned : std::max(most, turned);
  }
}

}  // namespace

PointNormalMesh point_normal_mesh(const Scheme<double>& scheme, const Mesh& mesh,
                                  const std::vector<VertexTarget>& targets, const PolygonOptions& options) {
  check(scheme, mesh, targets, options);
  std::vector<Level> levels = refine(scheme, mesh, scheme.period, options.rules);
  std::vector<Carrier> all = carriers(levels, targets);
  LimitCache cache(scheme);
  std::vector<Centre> centres;
  for (const Carrier& carrier : all) centres.push_back(carrier.centre);
  std::vector<LimitRows> rows = limit_rows(levels.back(), cache, centres);
  for (size_t i = 0; i < all.size(); ++i) all[i].rows = std::move(rows[i]);

  PointNormalMesh result;
  result.points = guessed(refinement_matrix(levels), mesh.positions, all, targets);
  result.level = std::move(levels.back());
  result.faces.assign(targets.size(), -1);
  const Topology& t = result.level.topology();
  std::vector<bool> taken(t.num_vertices(), false);
  for (const Carrier& carrier : all) {
    const VertexTarget& target = targets[carrier.target];
    const Face face = t.face(carrier.centre.start);
    const std::span<const Index> corners = t.vertices(face);
    PlanePolygon polygon = polygon_of(scheme, carrier, target, corners, result.points);
    for (const Index v : corners) {
      if (taken[v]) throw UnsupportedTopology(at(target) + ": its face shares a point with another target's");
      taken[v] = true;
    }
    if (target.normal) {
      const OrientationResult turn = turn_across(polygon, *target.normal, options.size / 0.5);
      if (turn == OrientationResult::impossible)
        throw InvalidMesh(at(target) +
                          ": its faces have no extent, so there is no polygon to turn; move its neighbours");
      if (turn == OrientationResult::over && (result.folded.empty() || result.folded.back() != target.vertex))
        result.folded.push_back(target.vertex);
    }
    move_to(polygon, target.position);
    for (size_t i = 0; i < corners.size(); ++i) result.points.row(corners[i]) = polygon.corners.row(Eigen::Index(i));
    if (result.faces[carrier.target] < 0) result.faces[carrier.target] = index(face);
  }
  measure(result, all, targets);
  return result;
}

}  // namespace sublimit

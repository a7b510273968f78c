// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/fit_jobs/fit_curvatures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/scheme/detail/check_levels.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Triangles whose own normal opposes all three of their corners' data.
Index opposed(const CurvatureMesh& mesh) {
  Index count = 0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto corner = [&](size_t c) -> const SurfacePoint& { return mesh.points[size_t(mesh.triangles[t + c])]; };
    const Vector3d n = (corner(1).position - corner(0).position).cross(corner(2).position - corner(0).position);
    count += n.dot(corner(0).normal) < 0 && n.dot(corner(1).normal) < 0 && n.dot(corner(2).normal) < 0;
  }
  return count;
}

FitLevel measured(const CurvatureMesh& mesh) {
  FitLevel level{.vertices = mesh.num_vertices(), .triangles = mesh.num_faces()};
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const SurfacePoint* corner[3];
    for (size_t c = 0; c < 3; ++c) corner[c] = &mesh.points[size_t(mesh.triangles[t + c])];
    Vector3d normal = Vector3d::Zero();
    for (size_t c = 0; c < 3; ++c) {
      const Vector3d edge = corner[(c + 1) % 3]->position - corner[c]->position;
      level.longest_edge = std::max(level.longest_edge, edge.norm());
      if (c == 0) normal = edge.cross(corner[2]->position - corner[0]->position);
    }
    if (normal.isZero(0)) continue;  // as thin as a line: it has no normal to be off
    for (const SurfacePoint* c : corner)
      level.normal_deviation = std::max(level.normal_deviation, angle(normal, c->normal));
  }
  return level;
}

/// Every vertex needs all its data.
void check_complete(const FitTargets& targets, const std::string& scheme, Index num_vertices) {
  std::vector<bool> found(size_t(num_vertices), false);
  for (size_t i = 0; i < targets.vertices.size(); ++i) {
    const VertexTarget& target = targets.vertices[i];
    found[size_t(target.vertex)] = true;
    if (!target.curvature)
      throw FormatError(targets.where(i) + "vertex " + format_number(target.vertex) + " has no " +
                        (target.normal ? "curvatures" : "normal") + "; " + scheme +
                        " needs nx,ny,nz,k1,k2,d1x,d1y,d1z everywhere");
  }
  const auto missing = std::ranges::find(found, false);
  if (missing != found.end())
    throw FormatError(targets.file.string() + ": vertex " + format_number(missing - found.begin()) +
                      " has no target; " + scheme + " needs one at every vertex");
}

/// Triangles in four at every level, about a vertex for two of them.
void check_size(const Mesh& mesh, int levels) {
  double triangles = 0;
  for (const Index size : mesh.face_sizes) triangles += size - 2;
  constexpr double most_triangles = std::numeric_limits<Index>::max() / 3, bytes = sizeof(SurfacePoint) + 80;
  const std::string what = format_number(levels) + " levels of " + format_number(mesh.num_faces()) + " faces";
  const int most = most_levels(triangles, 4, std::min(most_triangles, memory_limit() / bytes));
  const std::string advice = "use at most " + format_number(most);
  triangles *= std::pow(4.0, levels);
  if (triangles > most_triangles) throw ResourceError(what + " have more corners than 32-bit indices count; " + advice);
  check_memory(what, triangles * bytes, advice);
}

}  // namespace

CurvatureFit fit_curvatures(const GeometricSurfaceScheme& scheme, const Mesh& mesh, const FitTargets& targets,
                            const FitSettings& settings) {
  if (!mesh.holes.empty())
    throw InvalidMesh("face " + format_number(mesh.holes.front()) + " is a hole, for which " + scheme.name +
                      " has no rule; leave the face or its tag out");
  check_vertices(targets, Topology(view(mesh)), std::vector<bool>(size_t(mesh.num_faces()), false));
  check_size(mesh, settings.levels);
  check_complete(targets, scheme.name, mesh.num_vertices());
  CurvatureFit fit;
  fit.given = scheme.checked(curvature_mesh(mesh, targets.vertices));
  FitReport& report = fit.report;
  report = report_of("torus-pieces", scheme.name, mesh, targets);
  if (scheme.notes) report.notes = scheme.notes(fit.given);
  if (!mesh.creases.empty() || !mesh.corners.empty())
    report.notes.push_back(scheme.name + " has no creases: sharp edges and vertices of the mesh are smooth");
  if (!mesh.face_varying.empty()) report.notes.push_back("texture coordinates are left out");
  if (const Index count = opposed(fit.given); count > 0)
    report.notes.push_back(format_number(count) + " of " + format_number(fit.given.num_faces()) +
                           " triangles are wound against the normals of their corners; turn the faces or the normals, "
                           "and with these the signs of k1 and k2");
  fit.refined = fit.given;
  report.levels.push_back(measured(fit.refined));
  for (int k = 1; k <= settings.levels; ++k) {
    if (settings.progress) settings.progress("level " + std::to_string(k) + " of " + std::to_string(settings.levels));
    fit.refined = scheme.refine(fit.refined);
    report.levels.push_back(measured(fit.refined));
  }
  report.refinements = settings.levels;
  report.output_vertices = fit.refined.num_vertices();
  report.output_faces = fit.refined.num_faces();

  const Index count = static_cast<Index>(targets.size());
  report.position_error.resize(count);
  report.normal_error.resize(count);
  report.curvature_error.resize(count);
  for (Index i = 0; i < count; ++i) {
    const VertexTarget& target = targets.vertices[size_t(i)];
    const SurfacePoint& found = fit.refined.points[size_t(target.vertex)];
    report.position_error[i] = (found.position - target.position).norm();
    report.normal_error[i] = angle(found.normal, *target.normal);
    const auto [low, high] = std::minmax(target.curvature->k1, target.curvature->k2);
    const auto [found_low, found_high] = std::minmax(found.k1, found.k2);
    report.curvature_error[i] = std::max(std::abs(found_low - low), std::abs(found_high - high));
  }
  return fit;
}

Mesh output(const CurvatureMesh& mesh) {
  const Index count = mesh.num_vertices();
  Mesh out;
  out.positions.resize(count, 3);
  out.normals.resize(count, 3);
  for (Index v = 0; v < count; ++v) {
    out.positions.row(v) = mesh.points[size_t(v)].position;
    out.normals.row(v) = mesh.points[size_t(v)].normal;
  }
  out.face_sizes.assign(size_t(mesh.num_faces()), 3);
  out.face_vertices = mesh.triangles;
  return out;
}

}  // namespace sublimit

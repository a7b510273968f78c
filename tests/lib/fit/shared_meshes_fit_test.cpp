// SPDX-License-Identifier: Apache-2.0
// OpenSubdiv's regression shapes as data: the limit is made to pass through their vertices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes/shared_meshes.h"
#include "sublimit/fit/detail/interpolate.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/neighborhood/vertex_sides.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr double on_target = 1e-12, along_target = 1e-10;  // of the box, radians

/// Normals by the areas of the faces, where a vertex has one side.
std::vector<VertexTarget> vertices_of(const Mesh& mesh, const Level& level, bool normals) {
  Points N = Points::Zero(mesh.num_vertices(), 3);
  Index first = 0;
  for (const Index size : mesh.face_sizes) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    const auto corner = [&](Index i) { return mesh.face_vertices[first + i % size]; };
    for (Index i = 0; i < size; ++i) {
      const Eigen::Vector3d a = mesh.positions.row(corner(i)), b = mesh.positions.row(corner(i + 1));
      area += a.cross(b);
    }
    for (Index i = 0; i < size; ++i) N.row(corner(i)) += area;
    first += size;
  }
  std::vector<Index> sides(mesh.num_vertices(), 0);
  for (const Index v : vertex_sides(level).vertex) ++sides[v];
  const std::vector<bool> outside = vertices_without_surface(level.topology(), level.holes);
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (outside[v]) continue;
    targets.push_back({.vertex = v, .position = mesh.positions.row(v)});
    if (normals && sides[v] == 1 && N.row(v).norm() > 1e-12) targets.back().normal = N.row(v);
  }
  return targets;
}

TEST(SharedMeshInterpolation, PassesThroughPointsAndNormals) {
  const std::vector<SharedMesh> meshes = shared_meshes();
  if (meshes.empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": no surface is laid through their vertices";
  int tried = 0;
  for (const SharedMesh& shared : meshes) {
    const Mesh mesh = read_mesh(shared.path);
    if (shared.scheme == "bilinear" || (mesh.num_vertices() > 500 && !full_sweep())) continue;
    SCOPED_TRACE(shared.name);
    ++tried;
    const auto scheme = *find_scheme<double>(shared.scheme);
    for (const bool normals : {false, true}) {
      const auto targets = vertices_of(mesh, control_level(scheme, mesh), normals);
      const Interpolation found = interpolate(scheme, mesh, targets, {.conditioning = false});
      EXPECT_TRUE(found.solved()) << why_unsolved(found.attempts.back());
      // By the way that knows nothing of fitting.
      LimitCache cache(scheme);
      const LimitMatrices L = limit_matrices(found.level, cache);
      const LimitPoints limits = limit_points(L, found.level.topology(), found.points);
      std::vector<Index> side(found.level.topology().num_vertices(), -1);
      for (size_t s = L.side_vertex.size(); s-- > 0;) side[L.side_vertex[s]] = static_cast<Index>(s);
      double off = 0, turned = 0;
      for (const VertexTarget& target : targets) {
        off = std::max(off, (limits.position.row(target.vertex).transpose() - target.position).norm());
        const Index s = side[target.vertex];
        if (!target.normal || L.status[s] == LimitStatus::undefined_normal || L.status[s] == LimitStatus::hole)
          continue;
        const Eigen::Vector3d n = limits.normal.row(s), N = target.normal->normalized();
        turned = std::max(turned, std::atan2(n.cross(N).norm(), n.dot(N)));
      }
      EXPECT_LE(off, on_target * diagonal(mesh.positions)) << (normals ? "with normals" : "points alone");
      EXPECT_LE(turned, along_target);
    }
  }
  EXPECT_EQ(tried, full_sweep() ? 118 : 111);
}

}  // namespace
}  // namespace sublimit::testing

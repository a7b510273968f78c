// SPDX-License-Identifier: Apache-2.0
// OpenSubdiv's regression shapes as data for dual schemes: every vertex gets a plane polygon.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes/shared_meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/fit/detail/point_normal_polygons.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr double on_target = 1e-13, along_target = 1e-12;  // of the box, radians

/// Vertices with normals by the areas of their faces; nothing where faces cancel, and on borders as the scheme has it.
std::vector<VertexTarget> vertices_of(const Mesh& mesh, bool border_normals) {
  const Topology t(view(mesh));
  Points N = Points::Zero(mesh.num_vertices(), 3);
  for (Index h = 0; h < t.num_half_edges(); ++h) {
    const Eigen::Vector3d a = mesh.positions.row(index(t.tail(HalfEdge{h})));
    const Eigen::Vector3d b = mesh.positions.row(index(t.head(HalfEdge{h})));
    for (const Index v : t.vertices(t.face(HalfEdge{h}))) N.row(v) += a.cross(b);
  }
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const std::vector<HalfEdge> fans = t.fans(Vertex{v});
    if (fans.empty()) continue;
    targets.push_back({.vertex = v, .position = mesh.positions.row(v)});
    const bool closed = std::all_of(fans.begin(), fans.end(), [&](HalfEdge h) { return exists(t.twin(h)); });
    if (N.row(v).norm() > 1e-12 && (closed || border_normals)) targets.back().normal = N.row(v);
  }
  return targets;
}

TEST(SharedMeshPolygons, PassThroughPointsAndNormals) {
  const std::vector<SharedMesh> meshes = shared_meshes();
  if (meshes.empty())
    GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES << ": no polygons are laid through their vertices";
  for (const char* name : {"doo-sabin", "doo-sabin-averaging", "mid-edge", "mid-edge-habib-warren"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    int met = 0, refused = 0;
    for (const SharedMesh& shared : meshes) {
      const Mesh mesh = without_creases(read_mesh(shared.path));
      if (mesh.num_vertices() > 40 && !full_sweep()) continue;
      SCOPED_TRACE(scheme.name + " on " + shared.name);
      const auto targets = vertices_of(mesh, scheme.name.starts_with("doo-sabin"));
      try {
        const PointNormalMesh fit = point_normal_mesh(scheme, mesh, targets);
        ++met;
        EXPECT_LE(fit.position_residual.maxCoeff(), on_target * diagonal(fit.points));
        for (const double angle : fit.normal_residual) {
          if (std::isnan(angle)) continue;
          EXPECT_LE(angle, along_target);
        }
      } catch (const Error& error) {  // vertices between two faces; a face that is a point
        ++refused;
        const std::string what = error.what();
        EXPECT_TRUE(what.find("between two faces") != what.npos || what.find("no extent") != what.npos) << what;
      }
    }
    RecordProperty(scheme.name + "_met", met);
    RecordProperty(scheme.name + "_refused", refused);
    EXPECT_LE(refused, 9);
    EXPECT_GE(met, full_sweep() ? 113 : 60) << refused;
  }
}

}  // namespace
}  // namespace sublimit::testing

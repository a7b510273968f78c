// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/polygonize/polygonize.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <limits>
#include <vector>

#include "sublimit/base/error.h"

namespace sublimit {

Mesh polygonize(const FieldGrid& field) {
  [[maybe_unused]] static const bool started = (openvdb::initialize(), true);
  const openvdb::CoordBBox box({0, 0, 0}, {field.size[0] - 1, field.size[1] - 1, field.size[2] - 1});
  // It only reads, but has no type that says so.
  const openvdb::tools::Dense<double, openvdb::tools::LayoutXYZ> dense(box, const_cast<double*>(field.values.data()));
  const openvdb::DoubleGrid::Ptr grid = openvdb::DoubleGrid::create(field.largest);
  openvdb::tools::copyFromDense(dense, *grid, 0.);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, quads, 0.);  // in units of cells, where floats are finest
  if (4. * double(quads.size()) > std::numeric_limits<Index>::max())
    throw ResourceError("the surface has more quads than 32-bit indices count; take fewer cells");
  Mesh mesh;
  mesh.positions.resize(Eigen::Index(points.size()), 3);
  for (size_t i = 0; i < points.size(); ++i)
    mesh.positions.row(Eigen::Index(i)) =
        field.origin.transpose() + field.cell * Eigen::RowVector3d(points[i][0], points[i][1], points[i][2]);
  mesh.face_sizes.assign(quads.size(), 4);
  mesh.face_vertices.reserve(4 * quads.size());
  for (const openvdb::Vec4I& quad : quads)
    for (int k = 0; k < 4; ++k) mesh.face_vertices.push_back(Index(quad[k]));
  return mesh;
}

}  // namespace sublimit

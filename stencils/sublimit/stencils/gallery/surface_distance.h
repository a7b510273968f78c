// SPDX-License-Identifier: Apache-2.0
#pragma once
// Distance from a point to a surface of triangles: a tree of boxes, visited from near to far.
#include <Eigen/Geometry>

#include <array>
#include <vector>

#include "sublimit/mesh/topology.h"

namespace sublimit::gallery {

class SurfaceDistance {
 public:
  /// Faces of more than three corners are cut from their first one.
  /// @param points  #V x 3; copied
  SurfaceDistance(const Topology& topology, const Points& points);

  /// Distance of p to the nearest point of the surface. The search ends as soon as it is known to be `enough` or less;
  /// what is returned then is some number up to that.
  double operator()(const Eigen::Vector3d& p, double enough = 0) const;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  // triangles, of a leaf
    int left = 0, right = 0;   // nodes, of the others
  };
  int build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;  // the first is the root
};

}  // namespace sublimit::gallery

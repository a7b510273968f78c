// SPDX-License-Identifier: Apache-2.0
#pragma once
// Distance from a point to a surface of triangles, by a tree of boxes that is visited from near to far.
#include <Eigen/Geometry>

#include <array>
#include <vector>

#include "sublimit/mesh/topology.h"

namespace sublimit::gallery {

class SurfaceDistance {
 public:
  /// Builds the tree. Faces of more than three corners are cut into a fan from their first corner.
  /// @param points  #V x 3; copied
  SurfaceDistance(const Topology& topology, const Points& points);

  /// Returns the distance of p from the surface. If that is at most `enough`, the search ends early, and
  /// returns any number up to `enough`.
  double operator()(const Eigen::Vector3d& p, double enough = 0) const;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  // triangles of a leaf
    int left = 0, right = 0;   // children of an inner node
  };
  int build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;  // the first is the root
};

}  // namespace sublimit::gallery

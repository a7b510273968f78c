// SPDX-License-Identifier: Apache-2.0
#pragma once
// Binary trees of boxes, each node with a box around those below it, for searches from the nearest box on.
#include <Eigen/Geometry>

#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// A tree of boxes.
class BoxTree {
 public:
  BoxTree() = default;
  /// Makes the tree by recursively halving the set of boxes along the longest side of the extent of their
  /// centres. Deterministic.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// A node.
  struct Node {
    Eigen::AlignedBox3d box;
    Index first_child = -1;  ///< first child; the second one follows it; -1: a leaf
    Index item = -1;         ///< for a leaf: index of its box
  };
  /// Returns all nodes, the root first; empty if there are no boxes.
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

}  // namespace sublimit

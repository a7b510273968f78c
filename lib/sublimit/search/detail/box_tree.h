// SPDX-License-Identifier: Apache-2.0
#pragma once
// Boxes in a binary tree, each node with a box around those below it, to be searched from the nearest on.
#include <Eigen/Geometry>

#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

class BoxTree {
 public:
  BoxTree() = default;
  /// Halves of the boxes by the longest side of their centres' extent; equal input, equal tree.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  struct Node {
    Eigen::AlignedBox3d box;
    Index first_child = -1;  ///< the other one follows it
    Index item = -1;         ///< of a leaf: number of its box
  };
  /// The root first; none without boxes.
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

}  // namespace sublimit

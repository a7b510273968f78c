// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/box_tree.h"

#include <algorithm>
#include <numeric>

namespace sublimit {

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) {
  if (boxes.empty()) return;
  std::vector<Index> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * boxes.size() - 1);
  struct Range {
    Index node;
    size_t begin, end;
  };
  nodes_.emplace_back();
  std::vector<Range> todo{{0, 0, items.size()}};
  while (!todo.empty()) {
    const Range range = todo.back();
    todo.pop_back();
    Eigen::AlignedBox3d box, centres;
    for (size_t i = range.begin; i < range.end; ++i) {
      box.extend(boxes[size_t(items[i])]);
      centres.extend(boxes[size_t(items[i])].center());
    }
    nodes_[size_t(range.node)].box = box;
    if (range.end - range.begin == 1) {
      nodes_[size_t(range.node)].item = items[range.begin];
      continue;
    }
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const size_t middle = (range.begin + range.end) / 2;
    const auto at = [&](size_t i) { return items.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(range.begin), at(middle), at(range.end), [&](Index a, Index b) {
      const double x = boxes[size_t(a)].center()[axis], y = boxes[size_t(b)].center()[axis];
      return x != y ? x < y : a < b;
    });
    const auto child = static_cast<Index>(nodes_.size());
    nodes_[size_t(range.node)].first_child = child;
    nodes_.resize(nodes_.size() + 2);
    todo.push_back({child, range.begin, middle});
    todo.push_back({child + 1, middle, range.end});
  }
}

}  // namespace sublimit

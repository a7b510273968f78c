// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/distance_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sublimit/search/detail/net_distance.h"

namespace sublimit {
namespace {

/// What is still to be looked at, the nearest first.
struct Unsettled {
  double lower;
  Index node;           ///< of the tree, or -1
  std::int64_t number;  ///< of a cell; ties by it
  friend bool operator<(const Unsettled& a, const Unsettled& b) {
    return a.lower != b.lower ? a.lower > b.lower : a.number > b.number;
  }
};

}  // namespace

ProvedDistance DistanceBound::operator()(const Eigen::Vector3d& query, double distance, int most, PieceParts& cutter,
                                         std::span<const Index> without) const {
  const BoxTree& tree = parts_.tree();
  if (tree.nodes().empty() || !parts_.are_certain()) return {0, std::nullopt};
  const double rounding = parts_.rounding(query), enough = distance - 2e-13 * parts_.size() - 4 * rounding;
  const auto distance_of = [&](const Eigen::AlignedBox3d& box) { return box.exteriorDistance(query) - rounding; };
  ProvedDistance proved{distance, std::nullopt};
  std::vector<SurfacePart> cells;  // that are not in the tree
  std::vector<Unsettled> heap{{distance_of(tree.nodes()[0].box), 0, 0}};
  const auto push = [&](const Unsettled& c) {
    if (c.lower >= enough) {
      proved.lower = std::min(proved.lower, c.lower);
      return;
    }
    heap.push_back(c);
    std::push_heap(heap.begin(), heap.end());
  };
  const auto push_cell = [&](SurfacePart&& item, double least) {
    const double lower = std::max(least, distance_of(box_of(item.part)));
    cells.push_back(std::move(item));
    push({lower, -1, std::ssize(cells) - 1});
  };
  for (int looked = 0; !heap.empty();) {
    std::pop_heap(heap.begin(), heap.end());
    const Unsettled nearest = heap.back();
    heap.pop_back();
    if (nearest.node >= 0) {
      const BoxTree::Node& node = tree.nodes()[size_t(nearest.node)];
      if (node.item >= 0) {
        if (std::ranges::find(without, parts_.parts()[size_t(node.item)].address) != without.end()) continue;
        cells.push_back(parts_.parts()[size_t(node.item)]);
        push({nearest.lower, -1, std::ssize(cells) - 1});
      } else {
        for (const Index child : {node.first_child, node.first_child + 1})
          push({distance_of(tree.nodes()[size_t(child)].box), child, child});
      }
      continue;
    }
    if (++looked > most) {
      proved.lower = std::min(proved.lower, nearest.lower);
      break;
    }
    const SurfacePart item = std::move(cells[size_t(nearest.number)]);
    const CellCorners& corners = item.part.corners;
    if (!item.part.basis) {
      // Towards an extraordinary vertex parts are cut further than their corners can tell.
      if (is_smallest(corners) && box_of(item.part).diagonal().norm() <= 1e-14 * parts_.size() + rounding) {
        proved.lower = std::min(proved.lower, nearest.lower);
        continue;
      }
      for_each_child(item, cutter, [&](SurfacePart&& child) { push_cell(std::move(child), nearest.lower); });
      continue;
    }
    const PolynomialBasis& basis = *item.part.basis;
    double lower = std::numeric_limits<double>::infinity();
    bool settled = true;
    for (const Points& net : item.part.nets) {
      const NetDistance part(basis, net, query, rounding);
      const Eigen::RowVectorXd sum = net.colwise().sum();
      const double weight = net.cols() == 4 ? sum[3] : double(net.rows());
      const Eigen::Vector3d towards = (sum.head<3>().transpose() / weight - query).normalized();
      double least = part.lower(towards);
      if (least < enough)
        if (const std::optional<ConvexMinimum> minimum = part.convex_minimum(enough)) {
          least = std::max(least, minimum->lower);
          if (least < enough && minimum->at < enough && item.placed && item.part.nets.size() == 1) {
            const auto [u, v] = at_place(corners, basis.total(), minimum->uv[0], minimum->uv[1]);
            double so_far = std::min(proved.lower, std::max(least, nearest.lower));
            if (!heap.empty()) so_far = std::min(so_far, heap.front().lower);
            return {std::clamp(so_far, 0.0, distance),
                    Place{item.address, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)}};
          }
        }
      settled &= least >= enough;
      lower = std::min(lower, least);
    }
    lower = std::max(lower, nearest.lower);
    if (settled || lower >= enough || is_smallest(corners)) {
      proved.lower = std::min(proved.lower, lower);
      continue;
    }
    for_each_child(item, cutter, [&](SurfacePart&& quarter) { push_cell(std::move(quarter), lower); });
  }
  proved.lower = std::clamp(proved.lower, 0.0, distance);
  return proved;
}

}  // namespace sublimit

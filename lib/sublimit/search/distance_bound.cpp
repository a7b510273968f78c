// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/distance_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sublimit/base/parallel_for.h"
#include "sublimit/search/box_tree.h"
#include "sublimit/search/net_distance.h"

namespace sublimit {
namespace {

/// A part of an address.
struct Item {
  Index address = 0;
  PiecePart part;
  bool placed = true;  ///< its corners are known: not next to the border of a dual scheme
};

Eigen::AlignedBox3d box_of(const PiecePart& part) {
  Eigen::AlignedBox3d box;
  for (const Points& net : part.nets)
    for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(Eigen::Vector3d(net.row(i)));
  for (Eigen::Index i = 0; i < part.points.rows(); ++i) box.extend(Eigen::Vector3d(part.points.row(i)));
  const double reach = part.polynomial ? 0 : part.type->reach();
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Eigen::Vector3d margin = reach * box.sizes() + Eigen::Vector3d::Constant(1e-14 * largest);
  return {box.min() - margin, box.max() + margin};
}

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

struct DistanceBound::Parts {
  std::vector<Item> items;
  BoxTree tree;
  double size = 0;
};

DistanceBound::DistanceBound(const LimitSurface& surface, const Points& points) {
  const AddressPieces pieces(surface, points);
  // Deeper parts are made when they are asked for: few queries come near extraordinary vertices.
  const int levels = pieces.has_no_polynomials() ? 1 : 2;
  const Index addresses = surface.addresses().size();
  constexpr std::int64_t addresses_a_block = 32;
  std::vector<std::vector<Item>> blocks(size_t(num_blocks(addresses, addresses_a_block)));
  parallel_for_blocks(
      addresses,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        PieceParts cutter;
        std::vector<PiecePart> found;
        for (std::int64_t a = begin; a < end; ++a) {
          found.clear();
          pieces.visit(static_cast<Index>(a),
                       [&](const PieceType& type, const Points& local, const CellCorners& corners) {
                         cutter.find(type, local, corners, levels, found);
                       });
          for (PiecePart& part : found) blocks[size_t(block)].push_back({static_cast<Index>(a), std::move(part)});
        }
      },
      addresses_a_block);
  auto made = std::make_unique<Parts>();
  for (std::vector<Item>& block : blocks) std::move(block.begin(), block.end(), std::back_inserter(made->items));
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(made->items.size());
  for (const Item& item : made->items) boxes.push_back(box_of(item.part));
  made->tree = BoxTree(boxes);
  if (!boxes.empty()) made->size = made->tree.nodes()[0].box.diagonal().norm();
  parts_ = std::move(made);
}
DistanceBound::~DistanceBound() = default;

ProvedDistance DistanceBound::operator()(const Eigen::Vector3d& query, double distance, int most,
                                         PieceParts& cutter) const {
  const BoxTree& tree = parts_->tree;
  const double size = parts_->size, enough = distance - 2e-13 * size;
  ProvedDistance proved{distance, std::nullopt};
  std::vector<Item> cells;  // that are not in the tree
  std::vector<Unsettled> heap{{tree.nodes()[0].box.exteriorDistance(query), 0, 0}};
  const auto push = [&](const Unsettled& c) {
    if (c.lower >= enough) {
      proved.lower = std::min(proved.lower, c.lower);
      return;
    }
    heap.push_back(c);
    std::push_heap(heap.begin(), heap.end());
  };
  const auto push_cell = [&](Item&& item, double least) {
    const double lower = std::max(least, box_of(item.part).exteriorDistance(query));
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
        cells.push_back(parts_->items[size_t(node.item)]);
        push({nearest.lower, -1, std::ssize(cells) - 1});
      } else {
        for (const Index child : {node.first_child, node.first_child + 1})
          push({tree.nodes()[size_t(child)].box.exteriorDistance(query), child, child});
      }
      continue;
    }
    if (++looked > most) {
      proved.lower = std::min(proved.lower, nearest.lower);
      break;
    }
    const Item item = std::move(cells[size_t(nearest.number)]);
    const CellCorners& corners = item.part.corners;
    if (!item.part.polynomial) {
      if (is_smallest(corners)) {
        proved.lower = std::min(proved.lower, nearest.lower);
        continue;
      }
      const bool triangle = item.part.type->kind() == Piece::Kind::triangle;
      for (const PieceLink& link : item.part.type->children()) {
        const std::optional<CellCorners> own = child_of(corners, link.map, triangle);
        std::vector<PiecePart> child;
        cutter.find(*link.type, child_points(link, item.part.points), own.value_or(corners), 0, child);
        for (PiecePart& part : child) push_cell({item.address, std::move(part), item.placed && own}, nearest.lower);
      }
      continue;
    }
    const PolynomialBasis& basis = item.part.polynomial->basis;
    double lower = std::numeric_limits<double>::infinity();
    bool settled = true;
    for (const Points& net : item.part.nets) {
      const NetDistance part(basis, net, query);
      const Eigen::Vector3d towards = (net.colwise().mean().transpose() - query).normalized();
      double least = part.lower(towards);
      if (least < enough)
        if (const std::optional<ConvexMinimum> minimum = part.convex_minimum(size)) {
          least = std::max(least, minimum->lower);
          if (least < enough && minimum->at < enough && item.placed && item.part.nets.size() == 1) {
            const auto [u, v] = at_place(corners, basis.total(), minimum->uv[0], minimum->uv[1]);
            return {0, Sample{item.address, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)}};
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
    for (int k = 0; k < 4; ++k) {
      PiecePart quarter{
          quarter_of(corners, basis.total(), k), item.part.depth + 1, item.part.polynomial, {}, item.part.type, {}};
      for (size_t half = 0; half < item.part.nets.size(); ++half) {
        // Of a part that is cut along u = v the quarters beside that line are in one half.
        if (item.part.nets.size() > 1 && ((k == 1 && half == 1) || (k == 2 && half == 0))) continue;
        quarter.nets.push_back(cutter.nets(basis).quarter(k) * item.part.nets[half]);
      }
      push_cell({item.address, std::move(quarter), item.placed}, lower);
    }
  }
  proved.lower = std::clamp(proved.lower, 0.0, distance);
  return proved;
}

}  // namespace sublimit

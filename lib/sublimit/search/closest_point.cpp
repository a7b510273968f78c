// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/limit_cells.h"
#include "sublimit/search/box_tree.h"
#include "sublimit/search/distance_bound.h"
#include "sublimit/search/foot_point.h"

namespace sublimit {
namespace {

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<LimitCell>& cells) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(cells.size());
  for (const LimitCell& cell : cells) boxes.push_back(cell.box);
  return boxes;
}

/// A node or cell that is still to be searched.
struct Candidate {
  double squared_distance;  ///< at least
  Index node;
  bool is_cell;
  /// Order of a heap with the nearest on top; ties by number.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    if (a.squared_distance != b.squared_distance) return a.squared_distance > b.squared_distance;
    return a.node > b.node;
  }
};

struct Search {
  const std::vector<LimitCell>& cells;
  const BoxTree& tree;
  double tolerance;
  int most_cells;
  bool triangles;

  Foot operator()(const Eigen::Vector3d& query, const Sample* guess, FootSearch& foot_search, int& order,
                  std::vector<Candidate>& heap) const {
    const SearchDomain whole(triangles);
    Foot best{{}, std::numeric_limits<double>::infinity()};
    if (guess) best = foot_search(query, *guess, whole, order, best.squared_distance);
    // What is no nearer than this will not be missed.
    const auto near_enough = [&] {
      const double distance = std::sqrt(best.squared_distance) - tolerance;
      return distance > 0 ? distance * distance : 0;
    };
    double limit = near_enough();
    heap.assign(1, {tree.nodes()[0].box.squaredExteriorDistance(query), 0, false});
    for (int searched = 0; !heap.empty();) {
      std::pop_heap(heap.begin(), heap.end());
      const Candidate nearest = heap.back();
      heap.pop_back();
      if (nearest.squared_distance >= limit) break;
      const auto push = [&](const Candidate& c) {
        if (c.squared_distance >= limit) return;
        heap.push_back(c);
        std::push_heap(heap.begin(), heap.end());
      };
      const BoxTree::Node& node = tree.nodes()[size_t(nearest.node)];
      if (nearest.is_cell) {
        if (++searched > most_cells) break;
        const LimitCell& cell = cells[size_t(node.item)];
        // Only there, else the search would leave it for its neighbours' feet.
        const Foot foot = foot_search(query, cell.start, SearchDomain(triangles, cell.start, cell.radius), order,
                                      best.squared_distance);
        if (foot.squared_distance < best.squared_distance) {
          best = foot;
          limit = near_enough();
        }
      } else if (node.item >= 0) {
        push(
            {std::max(nearest.squared_distance, cells[size_t(node.item)].squared_distance(query)), nearest.node, true});
      } else {
        for (const Index child : {node.first_child, node.first_child + 1})
          push({tree.nodes()[size_t(child)].box.squaredExteriorDistance(query), child, false});
      }
    }
    const Foot foot = foot_search(query, best.place, whole, order, std::numeric_limits<double>::infinity());
    return foot.squared_distance < best.squared_distance ? foot : best;
  }
};

void check(const LimitSurface& surface, const Points& queries, std::span<const Sample> guess) {
  if (queries.cols() != 3)
    throw InvalidParameter("points to project have " + std::to_string(queries.cols()) + " coordinates, not 3");
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    const double largest = queries.row(i).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (largest <= farthest_coordinate) continue;
    throw InvalidParameter("point " + std::to_string(i) + " to project " +
                           (std::isfinite(largest) ? "has a coordinate above 1e150 in size" : "is not finite"));
  }
  if (!guess.empty() && guess.size() != size_t(queries.rows()))
    throw InvalidParameter(std::to_string(guess.size()) + " places to begin with for " +
                           std::to_string(queries.rows()) + " points; one each, or none");
  for (const Sample& s : guess)
    if (!is_inside(surface.addresses(), s))
      throw InvalidParameter("a place to begin with is on no face: face " + std::to_string(s.face) + " (" +
                             std::to_string(s.u) + ", " + std::to_string(s.v) + ")");
}

}  // namespace

ClosestPoints closest_points(const LimitSurface& surface, const Points& control, const Points& queries,
                             const ClosestPointOptions& options) {
  check(surface, queries, options.guess);
  const std::vector<LimitCell> cells = limit_cells(surface, control);
  if (cells.empty()) throw InvalidMesh("there is no surface to project on: no faces, or only holes");
  const BoxTree tree(boxes_of(cells));
  const BoundLimitSurface bound(surface, control);
  const Eigen::AlignedBox3d& all = tree.nodes()[0].box;
  const double size = all.sizes().norm();
  const Search search{cells, tree, 1e-13 * size, options.most_cells, surface.addresses().triangles()};

  // What a proof finds to be nearer becomes the foot.
  const auto prove = [&](const DistanceBound& bound_of, const Eigen::Vector3d& query, FootSearch& foot_search,
                         int& order, Foot& foot, PieceParts& cutter) {
    double lower = 0;
    for (int tries = 0; tries < 8; ++tries) {
      const ProvedDistance proved = bound_of(query, std::sqrt(foot.squared_distance), options.most_cells, cutter);
      lower = proved.lower;
      if (!proved.closer) break;
      const Foot next = foot_search(query, *proved.closer, SearchDomain(search.triangles), order,
                                    std::numeric_limits<double>::infinity());
      if (!(next.squared_distance < foot.squared_distance)) break;
      foot = next;
    }
    return lower;
  };

  const Eigen::Index count = queries.rows();
  ClosestPoints result;
  result.places.resize(size_t(count));
  std::optional<DistanceBound> bound_of;
  if (options.prove) {
    bound_of.emplace(surface, control);
    result.lower.resize(count);
  }
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        FootSearch foot_search(bound, surface.addresses().triangles(), size);
        std::vector<Candidate> heap;
        PieceParts cutter;
        for (std::int64_t i = begin; i < end; ++i) {
          int order = 2;  // anew for each point, or blocks would matter
          const Eigen::Vector3d query = queries.row(i);
          Foot foot =
              search(query, options.guess.empty() ? nullptr : &options.guess[size_t(i)], foot_search, order, heap);
          if (bound_of) result.lower[i] = prove(*bound_of, query, foot_search, order, foot, cutter);
          result.places[size_t(i)] = foot.place;
        }
      },
      64);
  const LimitSamples samples = bound.evaluate(result.places, 1);
  result.points = samples.position;
  result.normals = samples.normal;
  result.status = samples.status;
  result.distances = (result.points - queries).rowwise().norm();
  if (options.prove) result.lower = result.lower.cwiseMin(result.distances);
  return result;
}

}  // namespace sublimit

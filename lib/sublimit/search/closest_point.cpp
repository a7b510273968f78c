// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/limit_cells.h"
#include "sublimit/parts/parted_patches.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/patches/patches.h"
#include "sublimit/search/detail/box_tree.h"
#include "sublimit/search/detail/distance_bound.h"
#include "sublimit/search/detail/foot_point.h"
#include "sublimit/search/detail/winding.h"

namespace sublimit {
namespace {

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<LimitCell>& cells) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(cells.size());
  for (const LimitCell& cell : cells) boxes.push_back(cell.box);
  return boxes;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// The nearest faces so far, each with its foot, the nearest first.
class NearestFaces {
 public:
  /// @param limit  square of a distance: what is farther does not count
  NearestFaces(size_t count, double limit) : count_(count), limit_(limit) {}
  const std::vector<Foot>& foot_points() const { return foot_points_; }
  bool is_full() const { return foot_points_.size() == count_; }
  /// Square of the distance that another face has to be below.
  double limit() const { return is_full() ? foot_points_.back().squared_distance : limit_; }
  /// @return  where it came to be; -1 if it is no nearer than what there is
  std::ptrdiff_t insert(const Foot& foot) {
    if (!(foot.squared_distance <= limit_)) return -1;
    const auto same = std::ranges::find(foot_points_, foot.place.face, [](const Foot& f) { return f.place.face; });
    if (same != foot_points_.end()) {
      if (same->squared_distance <= foot.squared_distance) return -1;
      foot_points_.erase(same);
    }
    const auto at = std::ranges::upper_bound(foot_points_, foot.squared_distance, {}, &Foot::squared_distance);
    if (at == foot_points_.end() && is_full()) return -1;
    const std::ptrdiff_t place = at - foot_points_.begin();
    foot_points_.insert(at, foot);
    if (foot_points_.size() > count_) foot_points_.pop_back();
    return place;
  }

 private:
  size_t count_;
  double limit_;
  std::vector<Foot> foot_points_;
};

struct Search {
  const std::vector<LimitCell>& cells;
  const BoxTree& tree;
  double tolerance;
  std::int64_t most_cells;
  bool triangles;

  void operator()(const Eigen::Vector3d& query, const Place* guess, FootSearch& foot_search, int& order,
                  std::vector<Candidate>& heap, NearestFaces& best) const {
    const SearchDomain whole(triangles);
    if (guess) best.insert(foot_search(query, *guess, whole, order, infinity));
    // What is no nearer than this will not be missed; all within a radius is to be found.
    const auto near_enough = [&] {
      if (!best.is_full()) return best.limit();
      const double distance = std::sqrt(best.limit()) - tolerance;
      return distance > 0 ? distance * distance : 0;
    };
    double limit = near_enough();
    heap.assign(1, {tree.nodes()[0].box.squaredExteriorDistance(query), 0, false});
    for (std::int64_t searched = 0; !heap.empty();) {
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
        // Only there, else the search would leave it for its neighbours' foot points.
        const Foot foot =
            foot_search(query, cell.start, SearchDomain(triangles, cell.start, cell.radius), order, best.limit());
        if (best.insert(foot) >= 0) limit = near_enough();
      } else if (node.item >= 0) {
        push(
            {std::max(nearest.squared_distance, cells[size_t(node.item)].squared_distance(query)), nearest.node, true});
      } else {
        for (const Index child : {node.first_child, node.first_child + 1})
          push({tree.nodes()[size_t(child)].box.squaredExteriorDistance(query), child, false});
      }
    }
    const std::vector<Foot> found = best.foot_points();
    for (const Foot& foot : found) best.insert(foot_search(query, foot.place, whole, order, infinity));
  }
};

/// Bounds for the faces found; what a proof finds to be nearer is taken.
struct Proof {
  const DistanceBound& bound;
  double radius;
  int most_cells;
  bool triangles;

  std::vector<double> operator()(const Eigen::Vector3d& query, size_t count, FootSearch& foot_search, int& order,
                                 PieceParts& cutter, NearestFaces& best) const {
    std::vector<double> lower;
    std::vector<Index> before;
    for (int tries = 0; lower.size() < count;) {
      const bool found = lower.size() < best.foot_points().size();
      if (!found && std::isinf(radius)) break;
      const double distance = found ? std::sqrt(best.foot_points()[lower.size()].squared_distance) : radius;
      const ProvedDistance proved = bound(query, distance, most_cells, cutter, before);
      if (proved.closer && ++tries < 8) {
        const Foot foot = foot_search(query, *proved.closer, SearchDomain(triangles), order, infinity);
        const std::ptrdiff_t place = best.insert(foot);
        if (place >= 0) {  // faces before it keep their proofs
          lower.resize(std::min(lower.size(), size_t(place)));
          before.resize(lower.size());
          continue;
        }
      }
      if (!found) break;
      before.push_back(best.foot_points()[lower.size()].place.face);
      lower.push_back(proved.lower);
      tries = 0;
    }
    return lower;
  }
};

void check(const PartedSurface& surface, const Points& queries, const ClosestPointOptions& options) {
  const std::span<const Place> guess = options.guess;
  if (options.nearest < 1)
    throw InvalidParameter(std::to_string(options.nearest) + " nearest faces were asked for; 1 or more are right");
  if (options.most_cells < 1)
    throw InvalidParameter("a search of " + std::to_string(options.most_cells) +
                           " cells for each face finds nothing; 1 or more are right");
  if (!(options.radius >= 0)) throw InvalidParameter("a radius is not below 0, and a number");
  if (queries.cols() != 3)
    throw InvalidParameter("points to project have " + std::to_string(queries.cols()) + " coordinates, not 3");
  check_measurable(queries, "query point");
  if (!guess.empty() && guess.size() != size_t(queries.rows()))
    throw InvalidParameter(std::to_string(guess.size()) + " places to begin with for " +
                           std::to_string(queries.rows()) + " points; one each, or none");
  for (const Place& s : guess)
    if (!is_inside(surface.faces(), s))
      throw InvalidParameter("a place to begin with is on no face: face " + std::to_string(s.face) + " (" +
                             format_number(s.u) + ", " + format_number(s.v) + ")");
}

}  // namespace

ClosestPoints closest(const LimitSurface& surface, const Points& queries, const ClosestPointOptions& options) {
  return closest(PartedLimit(surface), queries, options);
}
ClosestPoints LimitSurface::closest(const Points& queries, const ClosestPointOptions& options) const {
  return sublimit::closest(*this, queries, options);
}
ClosestPoints LimitSurface::closest(const Points& queries) const { return sublimit::closest(*this, queries); }

ClosestPoints closest(const Patches& patches, const Points& queries, const ClosestPointOptions& options) {
  return closest(PartedPatches(patches.set(), patches.points()), queries, options);
}
ClosestPoints Patches::closest(const Points& queries, const ClosestPointOptions& options) const {
  return sublimit::closest(*this, queries, options);
}
ClosestPoints Patches::closest(const Points& queries) const { return sublimit::closest(*this, queries); }

ClosestPoints closest(const LimitMap& surface, const Points& control, const Points& queries,
                      const ClosestPointOptions& options) {
  return closest(PartedLimit(surface, control), queries, options);
}

ClosestPoints closest(const PartedSurface& surface, const Points& queries, const ClosestPointOptions& options) {
  check(surface, queries, options);
  const std::vector<LimitCell> cells = surface.cells();
  if (cells.empty()) throw InvalidMesh("there is no surface to project on: no faces, or only holes");
  const BoxTree tree(boxes_of(cells));
  const BoundSource& bound = surface.samples();
  const double size = tree.nodes()[0].box.sizes().norm();
  const bool triangles = surface.faces().triangles;
  const auto most = size_t(std::min<Index>(options.nearest, surface.faces().size));
  const Search search{cells, tree, 1e-13 * size, std::int64_t(most) * options.most_cells, triangles};
  std::optional<DistanceBound> bound_of;
  if (options.prove) bound_of.emplace(surface);

  const Eigen::Index count = queries.rows();
  struct Found {
    std::vector<Place> places;
    std::vector<double> lower;
  };
  std::vector<Found> found(static_cast<size_t>(count));
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        FootSearch foot_search(bound, triangles, size);
        std::vector<Candidate> heap;
        PieceParts cutter;
        for (std::int64_t i = begin; i < end; ++i) {
          int order = 2;  // anew for each point, or blocks would matter
          const Eigen::Vector3d query = queries.row(i);
          NearestFaces best(most, (options.radius + search.tolerance) * (options.radius + search.tolerance));
          search(query, options.guess.empty() ? nullptr : &options.guess[size_t(i)], foot_search, order, heap, best);
          if (bound_of)
            found[size_t(i)].lower = Proof{*bound_of, options.radius, options.most_cells, triangles}(
                query, most, foot_search, order, cutter, best);
          for (const Foot& foot : best.foot_points()) found[size_t(i)].places.push_back(foot.place);
        }
      },
      64);

  ClosestPoints result;
  result.first.push_back(0);
  for (const Found& one : found) {
    result.places.insert(result.places.end(), one.places.begin(), one.places.end());
    result.first.push_back(std::ssize(result.places));
  }
  LimitSamples samples;
  bound.evaluate(result.places, 1, true, samples);
  result.points = std::move(samples.position);
  result.normals = std::move(samples.normal);
  result.status = std::move(samples.status);
  result.distances.resize(std::ssize(result.places));
  if (options.prove) result.lower.resize(std::ssize(result.places));
  const std::vector<int> winding = options.is_signed ? winding_numbers(surface, queries) : std::vector<int>();
  for (Eigen::Index i = 0; i < count; ++i)
    for (std::int64_t row = result.first[size_t(i)]; row < result.first[size_t(i) + 1]; ++row) {
      const double distance = (result.points.row(row) - queries.row(i)).norm();
      result.distances[row] = options.is_signed && winding[size_t(i)] != 0 ? -distance : distance;
      if (options.prove)
        result.lower[row] = std::min(found[size_t(i)].lower[size_t(row - result.first[size_t(i)])], distance);
    }
  return result;
}

}  // namespace sublimit

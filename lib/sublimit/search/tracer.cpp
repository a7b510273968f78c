// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/tracer.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace sublimit {
namespace {

struct Extent {
  double low = 0, high = 0;
};

/// Smallest and largest distance along the ray of a box that it meets; nothing if it does not.
std::optional<Extent> along(const Eigen::AlignedBox3d& box, const Ray& ray, double slack) {
  Extent t{ray.tmin, ray.tmax};
  for (int k = 0; k < 3; ++k) {
    const double low = box.min()[k] - slack - ray.origin[k], high = box.max()[k] + slack - ray.origin[k],
                 d = ray.direction[k];
    if (d == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    const double a = low / d, b = high / d;
    t.low = std::max(t.low, std::min(a, b));
    t.high = std::min(t.high, std::max(a, b));
    if (t.low > t.high) return std::nullopt;
  }
  return t;
}

}  // namespace

std::vector<Tracer::Hit> Tracer::operator()(const Ray& ray, std::int64_t& undecided) {
  begin(ray);
  const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
  if (!nodes.empty()) push(nodes[0].box, 0, 0);
  return look(undecided);
}

std::vector<Tracer::Hit> Tracer::operator()(const Ray& ray, std::int64_t first, std::int64_t last,
                                            std::int64_t& undecided) {
  begin(ray);
  for (std::int64_t i = first; i < last; ++i) {
    const SurfacePart& part = parts_.parts()[size_t(i)];
    const Eigen::AlignedBox3d box = box_of(part.part);
    if (!along(box, ray, slack_)) continue;
    cells_.push_back(part);
    push(box, -1, std::ssize(cells_) - 1);
  }
  return look(undecided);
}

void Tracer::begin(const Ray& ray) {
  ray_ = &ray;
  frame_.emplace(ray.origin, ray.direction);
  slack_ = same_hit * parts_.size() + 8 * parts_.rounding(ray.origin);
  hits_.clear();
  heap_.clear();
  cells_.clear();
  undecided_ = 0;
  nearest_ = ray.tmax;
}

std::vector<Tracer::Hit> Tracer::look(std::int64_t& undecided) {
  const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
  for (int looked = 0; !heap_.empty();) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Waiting first = heap_.back();
    heap_.pop_back();
    if (!options_.all && first.t > nearest_) break;
    if (first.node >= 0) {
      const BoxTree::Node& node = nodes[size_t(first.node)];
      if (node.item >= 0) {
        cells_.push_back(parts_.parts()[size_t(node.item)]);
        heap_.push_back({first.t, -1, std::ssize(cells_) - 1});
        std::push_heap(heap_.begin(), heap_.end());
      } else {
        for (const Index child : {node.first_child, node.first_child + 1}) push(nodes[size_t(child)].box, child, child);
      }
      continue;
    }
    const SurfacePart part = std::move(cells_[size_t(first.number)]);
    if (++looked > options_.most_parts) {
      undecided_ += 1 + std::ssize(heap_);
      break;
    }
    look_at(part);
  }
  undecided += undecided_;
  return merged();
}

void Tracer::push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number) {
  const std::optional<Extent> t = along(box, *ray_, slack_);
  if (!t) return;
  heap_.push_back({t->low, node, number});
  std::push_heap(heap_.begin(), heap_.end());
}

void Tracer::look_at(const SurfacePart& cell) {
  const PiecePart& part = cell.part;
  const double slack = slack_;
  bool known = part.basis.has_value();
  for (size_t half = 0; half < part.nets.size(); ++half) {
    const SeenNet net(*part.basis, frame_->seen(part.nets[half]));
    if (!net.can_be_hit(slack)) continue;
    const SeenNet::Zero zero = net.zero(slack);
    const Eigen::Vector2d& uv = zero.uv;
    if (zero.kind == SeenNet::Zero::Kind::unknown) {
      known = false;
      break;
    }
    // Of a part that is cut along u = v each polynomial has its side.
    const bool own =
        part.nets.size() == 1 || (half == 0 ? uv.x() >= uv.y() - beyond_part : uv.y() >= uv.x() - beyond_part);
    if (zero.kind == SeenNet::Zero::Kind::one && own) add(cell, uv, zero.s, zero.reach);
  }
  if (known) return;
  const Eigen::AlignedBox3d box = box_of(part);
  if (box.diagonal().norm() <= slack) {
    ++undecided_;
    const Points middle = frame_->seen(box.center().transpose());
    // Where a ray touches, the surface is as near as that for the root of it.
    if (middle.leftCols(2).norm() <= 2 * slack) add(cell, {0.25, 0.25}, middle(0, 2), std::sqrt(slack * parts_.size()));
    return;
  }
  for_each_child(cell, cutter_, [&](SurfacePart&& child) {
    cells_.push_back(std::move(child));
    push(box_of(cells_.back().part), -1, std::ssize(cells_) - 1);
  });
}

void Tracer::add(const SurfacePart& cell, const Eigen::Vector2d& uv, double s, double reach) {
  const bool triangle = cell.part.is_triangle();
  const auto [u, v] = at_place(cell.part.corners, triangle, uv.x(), uv.y());
  const double t = s / frame_->length;
  if (!(t >= ray_->tmin && t <= ray_->tmax)) return;
  reach /= frame_->length;
  hits_.push_back(
      {t,
       reach,
       {cell.address, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, triangle ? 1 - std::clamp(u, 0.0, 1.0) : 1.0)}});
  nearest_ = std::min(nearest_, t + 2 * reach + apart());  // what counts as the same hit has to be found too
}

std::vector<Tracer::Hit> Tracer::merged() {
  std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
    return std::tuple(a.t, a.place.face, a.place.u, a.place.v) < std::tuple(b.t, b.place.face, b.place.u, b.place.v);
  });
  std::vector<Hit> result;
  double end = 0;
  for (const Hit& hit : hits_) {
    if (!result.empty() && hit.t - hit.reach <= end) {
      Hit& best = result.back();
      if (hit.reach < best.reach / 2 || (hit.reach < 2 * best.reach && hit.place.face < best.place.face)) best = hit;
      end = std::max(end, hit.t + hit.reach + apart());
      continue;
    }
    if (!options_.all && !result.empty()) break;
    result.push_back(hit);
    end = hit.t + hit.reach + apart();
  }
  return result;
}

}  // namespace sublimit

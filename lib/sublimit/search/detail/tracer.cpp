// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/tracer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/search/detail/seen_limit.h"

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

/// As many parts as are allowed in one part of the surface, times this, are in all that a ray meets.
constexpr std::int64_t wholes_a_ray = 64;

/// Of a part, in polynomial ones: children and limits are made of all points that it depends on.
std::int64_t work_of(const PiecePart& part) {
  constexpr std::int64_t points_a_net = 16;
  return 1 + part.points.rows() / points_a_net;
}

}  // namespace

std::vector<Tracer::Hit> Tracer::operator()(const Ray& ray) {
  begin(ray);
  const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
  if (!nodes.empty()) push(nodes[0].box, 0, 0);
  return look();
}

std::vector<Tracer::Hit> Tracer::operator()(const Ray& ray, std::int64_t first, std::int64_t last) {
  begin(ray);
  for (std::int64_t i = first; i < last; ++i) push_whole(parts_.parts()[size_t(i)]);
  return look();
}

void Tracer::begin(const Ray& ray) {
  ray_ = &ray;
  frame_.emplace(ray.origin, ray.direction);
  slack_ = same_hit * parts_.size() + 8 * parts_.rounding(ray.origin);
  hits_.clear();
  given_up_.reset();
  heap_.clear();
  cells_.clear();
  wholes_.clear();
  nearest_ = ray.tmax;
  within_to_ = -INFINITY;
}

std::vector<Tracer::Hit> Tracer::look() {
  const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
  for (std::int64_t looked = 0; !heap_.empty();) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Waiting first = heap_.back();
    heap_.pop_back();
    if (!options_.all && first.t > nearest_) break;
    if (first.node >= 0) {
      const BoxTree::Node& node = nodes[size_t(first.node)];
      if (node.item >= 0)
        push_whole(parts_.parts()[size_t(node.item)]);
      else
        for (const Index child : {node.first_child, node.first_child + 1}) push(nodes[size_t(child)].box, child, child);
      continue;
    }
    Cell cell = std::move(cells_[size_t(first.number)]);
    Whole& whole = wholes_[cell.whole];
    if (whole.is_given_up) continue;
    if (whole.looked >= options_.most_parts || looked >= wholes_a_ray * options_.most_parts) {
      give_up(cell, first.t);
      continue;
    }
    const size_t number = cell.whole;  // the cell goes, and so may the place of its whole
    work_ = work_of(cell.part.part);
    look_at(std::move(cell));
    wholes_[number].looked += work_;
    looked += work_;
  }
  return merged();
}

void Tracer::push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number) {
  const std::optional<Extent> t = along(box, *ray_, slack_);
  if (!t) return;
  heap_.push_back({t->low, node, number});
  std::push_heap(heap_.begin(), heap_.end());
}

void Tracer::push_whole(const SurfacePart& part) {
  wholes_.emplace_back();
  push_cell(SurfacePart(part), wholes_.size() - 1, 0);
}

void Tracer::push_cell(SurfacePart&& part, size_t whole, int side) {
  Cell cell{std::move(part), {}, {}, whole, side};
  const PiecePart& piece = cell.part.part;
  if (is_limit_alone(piece)) {
    cell.limits = parts_.limits().at(*piece.type, piece.points);
    cell.box = ray_box_of(piece, cell.limits);
  } else {
    cell.box = box_of(piece);
  }
  const Eigen::AlignedBox3d box = cell.box;
  if (!along(box, *ray_, slack_)) return;
  cells_.push_back(std::move(cell));
  push(box, -1, std::ssize(cells_) - 1);
}

void Tracer::look_at(Cell&& cell) {
  const PiecePart& part = cell.part.part;
  const bool decided = part.basis             ? decides_nets(cell)
                       : is_limit_alone(part) ? decides_limits(cell)
                                              : decides_points(cell);
  if (decided) return;
  // Many polynomial parts may be as near as counts to where one is not one to one; others come to their corners first.
  const double smallest = part.basis ? slack_ : slack_ / 32;
  if (cell.box.diagonal().norm() <= smallest) {
    add_smallest(cell);
    return;
  }
  cut(cell);
}

void Tracer::cut(const Cell& cell) {
  const PiecePart& part = cell.part.part;
  if (part.basis && !part.is_triangle() && part.nets.size() == 1) {
    // Only along what is much the longer way across the ray, as where it runs along a straight line of the surface; or
    // along the ray, once all else is as near as counts.
    const SeenNet net(*part.basis, frame_->seen(part.nets[0]));
    const SeenNet::Lengths length = net.strip(slack_) ? net.lengths_in_space() : net.lengths_across();
    constexpr double much = 8;
    if (length.u > much * length.v || length.v > much * length.u) {
      for (SurfacePart& half : halves_of(cell.part, length.u > length.v)) push_cell(std::move(half), cell.whole, 0);
      return;
    }
  }
  const double diagonal = cell.box.diagonal().norm();
  const bool has_digits = diagonal >= 1e-6 * parts_.size() + 1000 * parts_.rounding(ray_->origin);
  const int side = part.basis ? 0 : has_digits ? seen_side(cell) : cell.side;
  for_each_child(cell.part, cutter_, [&](SurfacePart&& child) { push_cell(std::move(child), cell.whole, side); });
}

bool Tracer::decides_nets(const Cell& cell) {
  const PiecePart& part = cell.part.part;
  bool all = true;
  for (size_t half = 0; half < part.nets.size(); ++half) {
    const SeenNet net(*part.basis, frame_->seen(part.nets[half]));
    if (!net.can_be_hit(slack_)) continue;
    const SeenZero zero = net.zero(slack_);
    const Eigen::Vector2d& uv = zero.uv;
    // Of a part that is cut along u = v each polynomial has its side.
    const bool own =
        part.nets.size() == 1 || (half == 0 ? uv.x() >= uv.y() - beyond_half : uv.y() >= uv.x() - beyond_half);
    if (zero.kind == SeenZero::Kind::one && own) add(cell, uv, zero.s, zero.reach, zero.side);
    if (zero.kind != SeenZero::Kind::unknown) continue;
    bool decided = false;
    if (part.nets.size() == 1)
      if (const std::optional<SeenNet::Side> side = net.side_on_ray(slack_))
        decided = adds_strip(cell, side->strip, side->reach, side->side);
    if (!decided)
      if (const std::optional<SeenStrip> strip = net.strip(slack_)) decided = adds_strip(cell, *strip, 0, 0);
    all = all && decided;
  }
  return all;
}

bool Tracer::decides_limits(const Cell& cell) {
  const PiecePart& part = cell.part.part;
  if (cell.limits.rows() == 0) {  // what diverges is no surface, and not known to be none
    give_up(cell, std::max(ray_->tmin, along(cell.box, *ray_, slack_)->low));
    return true;
  }
  if (part.type->reach() == 0 && !can_be_hit(frame_->seen(part.points), slack_)) return true;
  const SeenLimit seen(PieceGrid{part.is_triangle()}, frame_->seen(cell.limits));
  if (!seen.can_be_hit(slack_)) return true;
  const Points differences = part.points.bottomRows(part.points.rows() - 1).rowwise() - part.points.row(0);
  const SeenZero zero = seen.zero(slack_, [&](const Eigen::Vector2d& p) -> Eigen::Vector3d {
    work_ += 8 * work_of(part);  // some fifty levels down
    const PieceCoordinates place = part.is_triangle() ? triangle_place(p.x(), p.y()) : quad_place(p.x(), p.y());
    const Points x = piece_rows(*part.type, place, 0).rows.topRows(1) * differences + part.points.topRows(1);
    return frame_->seen(x).row(0).transpose();
  });
  if (zero.kind == SeenZero::Kind::one) add(cell, zero.uv, zero.s, zero.reach, zero.side);
  if (zero.kind != SeenZero::Kind::unknown) return true;
  const Points corners = seen_corners(cell);
  Points all(corners.rows() + cell.limits.rows(), 3);
  all << corners, frame_->seen(cell.limits);
  return adds_strip_or_corner(cell, all, seen.bend_across());
}

bool Tracer::decides_points(const Cell& cell) {
  const PiecePart& part = cell.part.part;
  const Points seen = frame_->seen(part.points);
  const double reach = part.type->reach() * cell.box.diagonal().norm();
  if (!can_be_hit(seen, slack_ + reach)) return true;
  const Points corners = seen_corners(cell);
  Points all(corners.rows() + seen.rows(), 3);
  all << corners, seen;
  return adds_strip_or_corner(cell, all, reach);
}

void Tracer::add_smallest(const Cell& cell) {
  const PiecePart& part = cell.part.part;
  const Points seen = part.basis ? frame_->seen(cell.box.center().transpose()) : seen_corners(cell);
  Eigen::Index nearest = 0;
  if (!(seen.leftCols(2).rowwise().norm().minCoeff(&nearest) <= 2 * slack_)) return;
  const CellCorner corner =
      part.is_triangle() ? triangle_corners[size_t(nearest) % 3] : square_corners[size_t(nearest)];
  const Eigen::Vector2d uv = part.basis
                                 ? (part.is_triangle() ? Eigen::Vector2d(1. / 3, 1. / 3) : Eigen::Vector2d(0.5, 0.5))
                                 : Eigen::Vector2d(corner.i, corner.j);
  add(cell, uv, seen(nearest, 2), 2 * slack_, cell.side);
}

Points Tracer::seen_corners(const Cell& cell) const {
  const PiecePart& part = cell.part.part;
  const int count = part.is_triangle() ? 3 : 4;
  Points corners(count, 3);
  if (is_limit_alone(part)) {
    const std::array<Eigen::Index, 4> rows = PieceGrid{part.is_triangle()}.corners();
    for (int c = 0; c < count; ++c) corners.row(c) = cell.limits.row(rows[size_t(c)]);
  } else {
    const Points differences = part.points.bottomRows(part.points.rows() - 1).rowwise() - part.points.row(0);
    for (int c = 0; c < count; ++c) corners.row(c) = part.type->corner_limit(c) * differences + part.points.row(0);
  }
  return frame_->seen(corners);
}

int Tracer::seen_side(const Cell& cell) const {
  const Points x = seen_corners(cell);
  double area = 0;
  for (Eigen::Index k = 1; k + 1 < x.rows(); ++k)
    area += (x(k, 0) - x(0, 0)) * (x(k + 1, 1) - x(0, 1)) - (x(k, 1) - x(0, 1)) * (x(k + 1, 0) - x(0, 0));
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool Tracer::adds_strip(const Cell& cell, const SeenStrip& strip, double reach, int side) {
  const double length = frame_->length;
  if (!is_short(strip) && !(strip.low / length <= within_to_ + apart())) return false;
  if (side == 0) within_to_ = std::max(within_to_, strip.high / length);
  add(cell, strip.uv, (strip.low + strip.high) / 2, reach + (strip.high - strip.low) / 2, side);
  return true;
}

bool Tracer::adds_strip_or_corner(const Cell& cell, const Points& points, double within) {
  const bool triangle = cell.part.part.is_triangle();
  const Eigen::Index count = triangle ? 3 : 4;
  constexpr std::array<Eigen::Index, 4> rows{0, 1, 2, 3};
  const Eigen::VectorXd off = points.leftCols(2).rowwise().norm();
  Eigen::Index nearest = 0;
  const bool has_corner = off.head(count).minCoeff(&nearest) <= 2 * slack_;
  // What else is met that near to a corner on the ray is the same hit.
  constexpr double near = 32;
  const bool is_on_ray = off.maxCoeff() + within <= (has_corner ? near : 2) * slack_;
  std::optional<SeenStrip> strip;
  if (is_on_ray)
    strip = {points.col(2).minCoeff(), points.col(2).maxCoeff()};
  else
    strip = strip_of(points, std::span(rows).first(size_t(count)), within, slack_);
  if (!strip) return false;
  if (!(has_corner && is_short(*strip))) return adds_strip(cell, *strip, 0, 0);
  const CellCorner corner = triangle ? triangle_corners[size_t(nearest)] : square_corners[size_t(nearest)];
  // What comes next of a needle is as near to the ray but for a few slacks.
  const double length = strip->high - strip->low;
  add(cell, Eigen::Vector2d(corner.i, corner.j), points(nearest, 2), 2 * slack_, is_on_ray ? cell.side : 0,
      strip->low - length, strip->high + length);
  return true;
}

void Tracer::add(const Cell& cell, const Eigen::Vector2d& uv, double s, double reach, int side, double low,
                 double high) {
  const bool triangle = cell.part.part.is_triangle();
  double u = 0, v = 0;
  if (cell.part.turned) {
    const std::array<Eigen::Vector2d, 3>& x = *cell.part.turned;
    const Eigen::Vector2d at = x[0] + uv.x() * (x[1] - x[0]) + uv.y() * (x[2] - x[0]);
    u = at.x(), v = at.y();
  } else {
    const std::array<double, 2> at = at_place(cell.part.part.corners, triangle, uv.x(), uv.y());
    u = at[0], v = at[1];
  }
  double t = s / frame_->length;
  reach /= frame_->length, low /= frame_->length, high /= frame_->length;
  if (side == 0) t = std::clamp(t, std::min(ray_->tmin, t + reach), std::max(ray_->tmax, t - reach));
  if (!(t >= ray_->tmin && t <= ray_->tmax)) return;
  u = std::clamp(u, 0.0, 1.0);
  hits_.push_back({t,
                   reach,
                   low,
                   high,
                   side == 0 ? HitKind::touching : HitKind::crossing,
                   side,
                   {cell.part.address, u, std::clamp(v, 0.0, triangle ? 1 - u : 1.0)}});
  nearest_ =
      std::min(nearest_, std::max(high, t + 2 * reach) + apart());  // what counts as the same hit has to be found too
}

void Tracer::give_up(const Cell& cell, double t) {
  wholes_[cell.whole].is_given_up = true;
  if (given_up_ && given_up_->t <= t) return;
  const bool triangle = cell.part.part.is_triangle();
  const double middle = triangle ? 1. / 3 : 0.5;
  const auto [u, v] = at_place(cell.part.part.corners, triangle, middle, middle);
  given_up_ = Hit{t, 0, t, t, HitKind::given_up, 0, {cell.part.address, u, v}};
}

std::vector<Tracer::Hit> Tracer::merged() {
  std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
    return std::tuple(a.low, a.t, a.place.face, a.place.u, a.place.v) <
           std::tuple(b.low, b.t, b.place.face, b.place.u, b.place.v);
  });
  std::vector<Hit> result;
  double end = 0;
  for (const Hit& hit : hits_) {
    if (!result.empty() && hit.low <= end) {
      Hit& best = result.back();
      const int side = best.side == hit.side ? best.side : 0;
      if (hit.reach < best.reach / 2 || (hit.reach < 2 * best.reach && hit.place.face < best.place.face)) best = hit;
      best.side = side;
      best.kind = side == 0 ? HitKind::touching : HitKind::crossing;
      end = std::max(end, hit.high + apart());
      continue;
    }
    if (!options_.all && !result.empty()) break;
    result.push_back(hit);
    end = hit.high + apart();
  }
  if (given_up_) {
    const auto later = std::ranges::find_if(result, [&](const Hit& hit) { return hit.t >= given_up_->t; });
    result.insert(later, *given_up_);
  }
  return result;
}

}  // namespace sublimit

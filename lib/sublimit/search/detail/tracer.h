// SPDX-License-Identifier: Apache-2.0
#pragma once
// One ray after the other through the parts of a surface.
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "sublimit/search/detail/seen_net.h"
#include "sublimit/search/detail/surface_parts.h"
#include "sublimit/search/intersect.h"

namespace sublimit {

/// Hits nearer to each other than that, relative to the surface's size, are one.
inline constexpr double same_hit = 1e-11;

/// Not to be shared between threads.
class Tracer {
 public:
  struct Hit {
    double t = 0;
    double reach = 0;          ///< how far off t may be: much where the ray grazes the surface
    double low = 0, high = 0;  ///< what counts as the same hit
    HitKind kind = HitKind::crossing;
    int side = 0;  ///< of the surface that the ray sees: 1, -1, or 0 where it turns over
    Place place;
  };

  /// @param parts  which must stay
  explicit Tracer(const SurfaceParts& parts, const RayOptions& options = {}) : parts_(parts), options_(options) {}
  explicit Tracer(const SurfaceParts&&, const RayOptions& = {}) = delete;
  void set(const RayOptions& options) { options_ = options; }

  /// By rising t.
  std::vector<Hit> operator()(const Ray& ray);
  /// Returns the hits with the parts [first, last) alone.
  std::vector<Hit> operator()(const Ray& ray, std::int64_t first, std::int64_t last);

 private:
  struct Waiting {
    double t;    ///< at least
    Index node;  ///< of the tree, or -1
    std::int64_t number;
    friend bool operator<(const Waiting& a, const Waiting& b) { return a.t != b.t ? a.t > b.t : a.number > b.number; }
  };
  struct Cell {
    SurfacePart part;
    Eigen::AlignedBox3d box;
    Points limits;     ///< on a grid, of parts without polynomials
    size_t whole = 0;  ///< the part of the surface that it comes from
    int side = 0;      ///< that is seen of it, where its points still tell
  };
  /// A part of the surface: how many of its own parts have been looked at, those of many points several times.
  struct Whole {
    std::int64_t looked = 0;
    bool is_given_up = false;
  };

  void begin(const Ray& ray);
  /// At all that waits, nearest first.
  std::vector<Hit> look();
  void push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number);
  void push_whole(const SurfacePart& part);
  void push_cell(SurfacePart&& part, size_t whole, int side);
  void look_at(Cell&& cell);
  void cut(const Cell& cell);
  /// True if all of the cell is decided.
  bool decides_nets(const Cell& cell);
  bool decides_limits(const Cell& cell);
  /// Decides by points for parts that become polynomials on a finer level: limits of corners, then all points.
  bool decides_points(const Cell& cell);
  /// A part that is as small as numbers go.
  void add_smallest(const Cell& cell);
  /// Limits of the corners, counter-clockwise, seen along the ray.
  Points seen_corners(const Cell& cell) const;
  int seen_side(const Cell& cell) const;
  /// Where a ray touches, the surface is as near as counts for the root of that.
  bool is_short(const SeenStrip& strip) const { return strip.high - strip.low <= std::sqrt(slack_ * parts_.size()); }
  /// True if a strip is one hit: short, or a continuation of one in which the ray was within the surface.
  bool adds_strip(const Cell& cell, const SeenStrip& strip, double reach, int side);
  /// Adds the hit with a thin part that has limits at its corners; a corner on the ray is the hit, as at a sharp tip.
  /// @param points  that hold the part, the corners first
  /// @param within  how far from them it may be
  bool adds_strip_or_corner(const Cell& cell, const Points& points, double within);
  void add(const Cell& cell, const Eigen::Vector2d& uv, double s, double reach, int side) {
    add(cell, uv, s, reach, side, s - reach, s + reach);
  }
  /// @param low, high  distances along the ray of what counts as the same hit
  void add(const Cell& cell, const Eigen::Vector2d& uv, double s, double reach, int side, double low, double high);
  void give_up(const Cell& cell, double t);
  /// Hits that are nearer to each other along the ray are one.
  double apart() const { return 100 * slack_ / frame_->length; }
  /// By t; what several parts have is one hit: the one that is known best, of the least face.
  std::vector<Hit> merged();

  const SurfaceParts& parts_;
  RayOptions options_;
  PieceParts cutter_;
  const Ray* ray_ = nullptr;
  std::optional<RayFrame> frame_;
  std::vector<Hit> hits_;
  std::optional<Hit> given_up_;
  std::vector<Waiting> heap_;
  std::vector<Cell> cells_;
  std::vector<Whole> wholes_;
  std::int64_t work_ = 0;  // at the part at hand
  double nearest_ = 0;
  double within_to_ = 0;  // t up to which the ray has been within the surface
  double slack_ = 0;      // how far off a ray counts as a hit
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Intersection of rays, one after another, with the parts of a surface.
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "sublimit/search/detail/seen_net.h"
#include "sublimit/search/detail/surface_parts.h"
#include "sublimit/search/intersect.h"

namespace sublimit {

/// Distance up to which hits count as the same, relative to the size of the surface.
inline constexpr double same_hit = 1e-11;

/// Tracer of rays. Use one per thread.
class Tracer {
 public:
  /// A hit.
  struct Hit {
    double t = 0;
    double reach = 0;          ///< error bound of t; large if the ray grazes the surface
    double low = 0, high = 0;  ///< interval of t in which hits count as the same
    HitKind kind = HitKind::crossing;
    int side = 0;  ///< side of the surface that is hit: 1, -1, or 0 if it changes here
    Place place;
  };

  /// @param parts  must outlive this
  explicit Tracer(const SurfaceParts& parts, const RayOptions& options = {}) : parts_(parts), options_(options) {}
  explicit Tracer(const SurfaceParts&&, const RayOptions& = {}) = delete;
  void set(const RayOptions& options) { options_ = options; }

  /// Returns all hits of a ray by ascending t.
  std::vector<Hit> operator()(const Ray& ray);
  /// Returns the hits with parts [first, last) only.
  std::vector<Hit> operator()(const Ray& ray, std::int64_t first, std::int64_t last);

 private:
  /// An entry of the queue.
  struct Waiting {
    double t;    ///< lower bound of t
    Index node;  ///< node of the tree, or -1: a cell
    std::int64_t number;
    friend bool operator<(const Waiting& a, const Waiting& b) { return a.t != b.t ? a.t > b.t : a.number > b.number; }
  };
  struct Cell {
    SurfacePart part;
    Eigen::AlignedBox3d box;
    Points limits;     ///< limits on a grid, for parts without polynomials
    size_t whole = 0;  ///< part of the surface that it belongs to
    int side = 0;      ///< side that is visible from the ray, as far as its points decide it
  };
  /// Work done for a part of the surface: number of its descendants examined, where those of many points count
  /// several times.
  struct Whole {
    std::int64_t looked = 0;
    bool is_given_up = false;
  };

  void begin(const Ray& ray);
  /// Examines all entries of the queue, nearest first, and returns the hits.
  std::vector<Hit> look();
  void push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number);
  void push_whole(const SurfacePart& part);
  void push_cell(SurfacePart&& part, size_t whole, int side);
  void look_at(Cell&& cell);
  void cut(const Cell& cell);
  /// Returns true if all hits of the cell are decided.
  bool decides_nets(const Cell& cell);
  bool decides_limits(const Cell& cell);
  /// Likewise for parts that become polynomials on a finer level: from limits of corners, then all points.
  bool decides_points(const Cell& cell);
  /// Adds the hit of a part that is too small to be divided.
  void add_smallest(const Cell& cell);
  /// Returns the limits of the corners, counter-clockwise, in the coordinates of the ray.
  Points seen_corners(const Cell& cell) const;
  int seen_side(const Cell& cell) const;
  /// True if a strip is short enough for a touching ray: the surface is within the slack along the root of the
  /// slack.
  bool is_short(const SeenStrip& strip) const { return strip.high - strip.low <= std::sqrt(slack_ * parts_.size()); }
  /// Adds a strip as one hit if it is short, or continues one in which the ray runs within the surface. Returns
  /// true if so.
  bool adds_strip(const Cell& cell, const SeenStrip& strip, double reach, int side);
  /// Adds the hit with a thin part that has limits at its corners. If a corner is on the ray, as at a sharp
  /// tip, it is the hit.
  /// @param points  points whose hull contains the part, the corners first
  /// @param within  largest distance of the part from this hull
  bool adds_strip_or_corner(const Cell& cell, const Points& points, double within);
  void add(const Cell& cell, const Eigen::Vector2d& uv, double s, double reach, int side) {
    add(cell, uv, s, reach, side, s - reach, s + reach);
  }
  /// @param low, high  interval along the ray in which hits count as the same
  void add(const Cell& cell, const Eigen::Vector2d& uv, double s, double reach, int side, double low, double high);
  void give_up(const Cell& cell, double t);
  /// Returns the distance in t below which hits count as the same.
  double apart() const { return 100 * slack_ / frame_->length; }
  /// Returns the hits sorted by t. Hits reported by several parts are merged into the most accurate one; ties
  /// go to the lowest face.
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
  std::int64_t work_ = 0;  // work for the current part
  double nearest_ = 0;
  double within_to_ = 0;  // t up to which the ray runs within the surface
  double slack_ = 0;      // distance from the ray that counts as a hit
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// One ray after the other through the parts of a surface.
#include <cstdint>
#include <optional>
#include <vector>

#include "sublimit/search/intersect.h"
#include "sublimit/search/seen_net.h"
#include "sublimit/search/surface_parts.h"

namespace sublimit {

/// Hits nearer to each other than that, relative to the surface's size, are one.
inline constexpr double same_hit = 1e-11;

/// Not to be shared between threads.
class Tracer {
 public:
  struct Hit {
    double t = 0;
    double reach = 0;  ///< how far off t may be: much where the ray grazes the surface
    Sample place;
  };

  /// @param parts  which must stay
  explicit Tracer(const SurfaceParts& parts, const RayOptions& options = {}) : parts_(parts), options_(options) {}
  explicit Tracer(const SurfaceParts&&, const RayOptions& = {}) = delete;
  void set(const RayOptions& options) { options_ = options; }

  /// By rising t.
  /// @param undecided  is counted up
  std::vector<Hit> operator()(const Ray& ray, std::int64_t& undecided);
  /// Of the parts [first, last) alone.
  std::vector<Hit> operator()(const Ray& ray, std::int64_t first, std::int64_t last, std::int64_t& undecided);

 private:
  struct Waiting {
    double t;    ///< at least
    Index node;  ///< of the tree, or -1
    std::int64_t number;
    friend bool operator<(const Waiting& a, const Waiting& b) { return a.t != b.t ? a.t > b.t : a.number > b.number; }
  };

  void begin(const Ray& ray);
  /// At all that waits, nearest first.
  std::vector<Hit> look(std::int64_t& undecided);
  void push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number);
  void look_at(const SurfacePart& cell);
  void add(const SurfacePart& cell, const Eigen::Vector2d& uv, double s, double reach);
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
  std::vector<Waiting> heap_;
  std::vector<SurfacePart> cells_;
  std::int64_t undecided_ = 0;
  double nearest_ = 0;
  double slack_ = 0;  // how far off a ray counts as a hit
};

}  // namespace sublimit

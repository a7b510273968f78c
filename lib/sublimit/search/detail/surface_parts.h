// SPDX-License-Identifier: Apache-2.0
#pragma once
// A whole surface as a tree of parts with boxes, from which branch and bound starts. Polynomial and rational
// parts are given by Bernstein coefficients, others by the points that they depend on.
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/nets/piece_parts.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/search/detail/box_tree.h"
#include "sublimit/search/detail/piece_limits.h"

namespace sublimit {

/// A part of an address.
struct SurfacePart {
  Index address = 0;
  PiecePart part;
  bool placed = true;  ///< true if its corners are known; false at borders in dual schemes
  /// (u, v) of the corners of a triangle that is no quarter of its parent, as in schemes that rotate; it is not
  /// `placed`.
  std::optional<std::array<Eigen::Vector2d, 3>> turned;
};

/// Returns (u, v) of the corners of a child of a triangle, from those of the triangle.
std::array<Eigen::Vector2d, 3> child_triangle(const std::array<Eigen::Vector2d, 3>& corners, const PieceMap& map);
/// Returns (u, v) of the corners of a triangular part.
std::array<Eigen::Vector2d, 3> triangle_of(const SurfacePart& part);

/// Returns a box of a part: that of its coefficients, or that of its points enlarged by `PieceType::reach`.
Eigen::AlignedBox3d box_of(const PiecePart& part);
/// Returns the box of a part for rays. If weights may be negative: a box of its limits, enlarged by an estimate of what
/// lies between them; if the part diverges: a box of its points.
/// @param limits  limits on the grid of a part without polynomials
Eigen::AlignedBox3d ray_box_of(const PiecePart& part, const Points& limits);
/// True for a part of a scheme without polynomials, which is only known by its limits.
inline bool is_limit_alone(const PiecePart& part) { return !part.basis && part.type->types().has_no_polynomials(); }

/// Calls visit(part) for the quarters of a polynomial or rational part, or the children of another.
/// @param cutter  belongs to the calling thread
template <class Visit>
void for_each_child(const SurfacePart& whole, PieceParts& cutter, const Visit& visit) {
  const PiecePart& part = whole.part;
  if (!part.basis) {
    for (const PieceLink& link : part.type->children()) {
      const std::optional<CellCorners> own = child_of(part.corners, link.map, part.is_triangle());
      std::vector<PiecePart> found;
      cutter.find(*link.type, child_points(link, part.points), own.value_or(part.corners), 0, found);
      std::optional<std::array<Eigen::Vector2d, 3>> turned;
      if (link.map.is_triangle && (whole.turned || !own)) turned = child_triangle(triangle_of(whole), link.map);
      for (PiecePart& child : found) visit(SurfacePart{whole.address, std::move(child), whole.placed && own, turned});
    }
    return;
  }
  for (int k = 0; k < 4; ++k) visit(SurfacePart{whole.address, cutter.quarter(part, k), whole.placed, {}});
}

/// Returns the halves of a square polynomial or rational part with one net.
/// @param by_u  true: halve u, false: halve v
std::array<SurfacePart, 2> halves_of(const SurfacePart& whole, bool by_u);

/// Function that makes boxes: `box_of`, or `ray_box_of`.
enum class PartBoxes { for_distances, for_rays };

/// All parts of a surface.
class SurfaceParts {
 public:
  /// @param surface  needed during construction only; the map or patches that it refers to must outlive this
  explicit SurfaceParts(const PartedSurface& surface, PartBoxes boxes = PartBoxes::for_distances);
  const std::vector<SurfacePart>& parts() const { return parts_; }
  /// Returns the tree of the parts' boxes; empty if there is no surface.
  const BoxTree& tree() const { return tree_; }
  /// Returns the diagonal of the box of all parts.
  double size() const { return tree_.nodes().empty() ? 0 : tree_.nodes()[0].box.diagonal().norm(); }
  /// Returns a bound of rounding errors in differences of the surface and a point. It depends on the size of
  /// coordinates, not of differences, and allows for sums of some dozen terms.
  double rounding(const Eigen::Vector3d& point) const {
    return 1e-14 * (size() + std::max(largest_, point.cwiseAbs().maxCoeff()));
  }
  /// True if all faces have parts, and boxes are proved bounds: no part has negative weights, with which they
  /// are estimates.
  bool are_certain() const { return certain_; }
  /// Returns the limits of pieces without polynomials, by type.
  const PieceLimits& limits() const { return *limits_; }

 private:
  std::vector<SurfacePart> parts_;
  BoxTree tree_;
  std::unique_ptr<const PieceLimits> limits_ = std::make_unique<PieceLimits>();
  double largest_ = 0;  // coordinate
  bool certain_ = true;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// All of a surface as parts with boxes, in a tree: polynomial and rational ones as Bernstein coefficients, others as
// the points that they depend on. What branch and bound begins with.
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/nets/piece_parts.h"
#include "sublimit/search/detail/box_tree.h"
#include "sublimit/search/detail/piece_limits.h"
#include "sublimit/search/detail/searched_surface.h"

namespace sublimit {

/// A part of an address.
struct SurfacePart {
  Index address = 0;
  PiecePart part;
  bool placed = true;  ///< its corners are known: not next to the border of a dual scheme
  /// (u, v) of the corners of a triangle that comes from no quarters, as of schemes that turn: these are not `placed`.
  std::optional<std::array<Eigen::Vector2d, 3>> turned;
};

/// (u, v) of the corners of a child of a triangle, by those of the triangle.
std::array<Eigen::Vector2d, 3> child_triangle(const std::array<Eigen::Vector2d, 3>& corners, const PieceMap& map);
/// (u, v) of the corners of a triangular part.
std::array<Eigen::Vector2d, 3> triangle_of(const SurfacePart& part);

/// A box that holds a part: the hull of its coefficients, or of its points, widened by their reach.
Eigen::AlignedBox3d box_of(const PiecePart& part);
/// Returns the box of a part for rays. If weights may be negative: a box of its limits, enlarged by an estimate of what
/// lies between them; if the part diverges: a box of its points.
/// @param limits  of a part without polynomials
Eigen::AlignedBox3d ray_box_of(const PiecePart& part, const Points& limits);
/// A part of a scheme without polynomials: what is known of it comes from its limits.
inline bool is_limit_alone(const PiecePart& part) { return !part.basis && part.type->types().has_no_polynomials(); }

/// The quarters of a polynomial or rational part, or the children of another.
/// @param cutter  of the calling thread
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

/// Halves of the square of a polynomial or rational part with one net.
/// @param by_u  whether u is halved, else v
std::array<SurfacePart, 2> halves_of(const SurfacePart& whole, bool by_u);

/// `box_of`, or `ray_box_of`.
enum class PartBoxes { for_distances, for_rays };

class SurfaceParts {
 public:
  /// @param surface  which may go; what a `SearchedLimit` is of has to stay
  explicit SurfaceParts(const SearchedSurface& surface, PartBoxes boxes = PartBoxes::for_distances);
  const std::vector<SurfacePart>& parts() const { return parts_; }
  /// Returns the tree of the parts' boxes; empty if there is no surface.
  const BoxTree& tree() const { return tree_; }
  /// Returns the diagonal of the box of all parts.
  double size() const { return tree_.nodes().empty() ? 0 : tree_.nodes()[0].box.diagonal().norm(); }
  /// How far rounding may move differences of the surface and a point: by the coordinates of both, however small these
  /// differences are, with room for sums of some dozen terms.
  double rounding(const Eigen::Vector3d& point) const {
    return 1e-14 * (size() + std::max(largest_, point.cwiseAbs().maxCoeff()));
  }
  /// There are parts of all faces, and hulls hold what they say: no weight that a part's own points have is negative,
  /// which makes them estimates.
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

// SPDX-License-Identifier: Apache-2.0
#pragma once
// All of a surface as parts with boxes, in a tree: polynomial and rational ones as Bernstein coefficients, others as
// the points that they depend on. What branch and bound begins with.
#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "sublimit/limit/piece_parts.h"
#include "sublimit/search/box_tree.h"
#include "sublimit/search/searched_surface.h"

namespace sublimit {

/// A part of an address.
struct SurfacePart {
  Index address = 0;
  PiecePart part;
  bool placed = true;  ///< its corners are known: not next to the border of a dual scheme
};

/// A box that holds a part: the hull of its coefficients, or of its points, widened by their reach.
Eigen::AlignedBox3d box_of(const PiecePart& part);

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
      for (PiecePart& child : found) visit(SurfacePart{whole.address, std::move(child), whole.placed && own});
    }
    return;
  }
  for (int k = 0; k < 4; ++k) visit(SurfacePart{whole.address, cutter.quarter(part, k), whole.placed});
}

class SurfaceParts {
 public:
  explicit SurfaceParts(const SearchedSurface& surface);
  const std::vector<SurfacePart>& parts() const { return parts_; }
  /// Of their boxes; empty where there is no surface.
  const BoxTree& tree() const { return tree_; }
  /// The diagonal of all of it.
  double size() const { return tree_.nodes().empty() ? 0 : tree_.nodes()[0].box.diagonal().norm(); }
  /// How far rounding may move differences of the surface and a point: by the coordinates of both, however small these
  /// differences are, with room for sums of some dozen terms.
  double rounding(const Eigen::Vector3d& point) const {
    return 1e-14 * (size() + std::max(largest_, point.cwiseAbs().maxCoeff()));
  }
  /// There are parts of all faces, and hulls hold what they say: no weight that a part's own points have is negative,
  /// which makes them estimates.
  bool are_certain() const { return certain_; }

 private:
  std::vector<SurfacePart> parts_;
  BoxTree tree_;
  double largest_ = 0;  // coordinate
  bool certain_ = true;
};

}  // namespace sublimit

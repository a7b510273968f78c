// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sides that faces of patches share. Patches know nothing of each other, so that sides are compared as curves: two are
// one if they are the same curve in the same parameter, either way round; a side may also be a single point, a pole.
// `patch_seams` is about whole sides of B-splines, which it also finds in other parameters and in chains, since it only
// measures how they join; here numbers of places depend on the answer, so that no two of a class may be far apart.
//
//   const SharedSides sides(surface.samples(), surface.faces(), {.same = 1e-9, .degree = 3});
//   if (sides.number(0, {cell_steps, 0}) == sides.number(1, {0, 0})) std::cout << "faces 0 and 1 have a common
//   corner\n";
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/nets/piece_parts.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// What counts as the same side.
struct SideOptions {
  double same = 0;  ///< distance up to which points are the same, > 0
  int degree = 3;   ///< largest degree of sides: curves are compared at twice as many points and one more
};

/// The sides of all faces, and which of them are one. A side that lies on a part of another, or is the same curve in
/// another parameter, is a side of its own.
class SharedSides {
 public:
  SharedSides(const BoundSource& surface, FaceCount faces, const SideOptions& options);

  /// Returns a number that is the same for all faces that share a place; SharedPlaces::not_shared inside faces and
  /// on sides that no other face has.
  std::int64_t number(Index face, const CellCorner& corner) const;
  /// Returns true if a side of the face is a curve that ends where it begins.
  bool has_loop(Index face) const;
  /// Returns which side is not that of exactly one other, the opposite way, nor a single point; empty if none is.
  std::string why_not_closed() const;
  /// Returns the largest distance of points from the first ones that they are one with; at most twice `same`.
  double gap() const { return gap_; }

 private:
  struct Side {
    std::int64_t line = -1;  ///< line that it is one with others, from 0; -1: none
    bool reversed = false;   ///< runs against the line
    bool is_point = false;
  };

  size_t corners_;                    // of a face
  std::vector<Side> sides_;           // by face
  std::vector<std::int64_t> corner_;  // by face: the first of all corners that are the same point
  double gap_ = 0;
};

}  // namespace sublimit

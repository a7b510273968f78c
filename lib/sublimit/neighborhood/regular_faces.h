// SPDX-License-Identifier: Apache-2.0
#pragma once
// Regular faces, told from all others at a glance: most faces of a large mesh are alike, and need no walk and no
// signature to be known.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Quadrilaterals whose corners have valence 4, or triangles whose corners have valence 6, with faces of the same size
/// around, inside the mesh, with nothing sharp at the corners or on their edges.
class RegularFaces {
 public:
  /// @param level    whose faces and half-edges are to stay
  /// @param corners  of the faces: 3 or 4
  RegularFaces(const Level& level, int corners);

  bool is_regular(Face face) const {
    for (const Index v : t_.vertices(face))
      if (!plain_[v]) return false;
    return true;
  }
  /// The points of a face and of those around it, in the order in which `PieceWalker` finds them in one ring.
  /// @param out  `num_points` of them
  /// @return  false for a face that is not regular
  bool points(Face face, Index* out) const;
  int num_points() const { return corners_ == 3 ? 12 : 16; }

 private:
  const Topology& t_;
  int corners_;
  std::vector<std::uint8_t> plain_;  // of each vertex
};

}  // namespace sublimit

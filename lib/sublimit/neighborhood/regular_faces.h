// SPDX-License-Identifier: Apache-2.0
#pragma once
// Detects regular faces without walking around them or computing signatures: most faces of a large mesh are regular.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Quadrilaterals whose corners have valence 4, or triangles whose corners have valence 6, with faces of the same size
/// around, inside the mesh, with nothing sharp at the corners or on their edges, and as many points around as they
/// would have in a plane: on a torus of three quadrilaterals around, some are the same, and the type is another.
class RegularFaces {
 public:
  /// @param level    whose faces and half-edges are to stay
  /// @param corners  of the faces: 3 or 4
  RegularFaces(const Level& level, int corners);
  RegularFaces(const Level&&, int) = delete;

  bool is_regular(Face face) const { return regular_[index(face)] != 0; }
  /// The points of a face and of those around it, in the order in which `PieceWalker` finds them in one ring.
  /// @param out  `num_points` of them
  /// @return  false for a face that is not regular
  bool points(Face face, Index* out) const;
  int num_points() const { return corners_ == 3 ? 12 : 16; }

 private:
  void find_points(Face face, Index* out) const;
  const Topology& t_;
  int corners_;
  std::vector<std::uint8_t> regular_;  // of each face
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Detects regular faces without walking around them or computing signatures: most faces of a large mesh are regular.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Regular faces of a level: quadrilaterals with corners of valence 4, or triangles with corners of valence 6,
/// inside the mesh, surrounded by faces of the same size, and with no sharp corner or sharp edge at a corner.
/// Their 16 or 12 points must be distinct: on a torus of three quadrilaterals around some coincide, which is
/// another type.
class RegularFaces {
 public:
  /// @param level    its topology must outlive this
  /// @param corners  number of corners of the faces, 3 or 4
  RegularFaces(const Level& level, int corners);
  RegularFaces(const Level&&, int) = delete;

  bool is_regular(Face face) const { return regular_[index(face)] != 0; }
  /// Writes the points of a face and of the faces around it, in the order of a one-ring `PieceWalker`.
  /// @param out  room for `num_points()` indices
  /// @return  false, with nothing written, if the face is not regular
  bool points(Face face, Index* out) const;
  int num_points() const { return corners_ == 3 ? 12 : 16; }

 private:
  void find_points(Face face, Index* out) const;
  const Topology& t_;
  int corners_;
  std::vector<std::uint8_t> regular_;  // of each face
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangular Bezier patches. Control points b_ijk, i + j + k = n, in the order (n-j-k, j, k), j fastest; (u,v) are the
// barycentric coordinates (1-u-v, u, v), corners (0,0), (1,0), (0,1). Control points are values of the blossom,
// b_ijk = f(V0^i, V1^j, V2^k), which gives rows of points, of derivatives, and of the nets of quarters.
//
// The quarters of (V0, V1, V2) with midpoints M are (V0 M01 M02), (M01 V1 M12), (M02 M12 V2), (M12 M02 M01); face
// 4 f + c of a net is quarter c of face f of the coarser one. Their control points lie on one triangular lattice.
// Source: Ramshaw 1989, "Blossoms are polar forms"; Farin 2002, "Curves and Surfaces for CAGD", section 17.
#include "sublimit/patches/patch.h"

namespace sublimit {

/// A triangular Bezier patch, or one of its refinements.
class TrianglePatch : public Patch {
 public:
  /// @param level  number of times that it has been quartered
  /// @throws InvalidParameter  a degree that is not 1 to max_degree, a negative level
  /// @throws ResourceError     more control points or faces than 32-bit indices count
  explicit TrianglePatch(int degree, int level = 0);

  int degree() const { return degree_; }
  int level() const { return level_; }
  Index num_points() const override { return lattice_size(side_); }
  FaceCount faces() const override { return {num_faces_, true}; }

  std::vector<Index> slots(Index face) const override;
  LimitStatus rows(const Place& place, int order, WeightRows& weights) const override;
  std::string type(Index face) const override;

  /// Returns the place of parameters (u,v) of the whole patch. On edges between quarters it is in the first of
  /// them, unless a side is given.
  Place place(const Parameters& parameters) const override;
  Parameters parameters(const Place& place) const override;
  /// Lengths are negative for quarters that are rotated by 180 degrees.
  Lengths lengths(Index face) const override;
  std::optional<BezierRows> bezier(Index face) const override;
  Refined refined() const override;

  /// Returns the number of points of a triangular lattice with `side` steps per side.
  static Index lattice_size(Index side) { return (side + 1) * (side + 2) / 2; }

 private:
  /// A face in the lattice: its corner V0, and the step of one control point towards V1 and V2.
  struct Corner {
    Index j = 0, k = 0;  ///< position of V0 in the lattice
    Index step = 1;      ///< 1, or -1 if rotated by 180 degrees
  };
  Corner corner(Index face) const;
  Index point(Index j, Index k) const { return k * (side_ + 1) - k * (k - 1) / 2 + j; }

  int degree_, level_;
  Index side_ = 0, num_faces_ = 0;
};

}  // namespace sublimit

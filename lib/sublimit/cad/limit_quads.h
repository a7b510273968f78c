// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit surfaces as four-sided Bezier patches: exact patches for polynomial cells, in rings around
// extraordinary vertices, and a fitted cap for the rest in the middle of the rings, once it is close enough to
// the limit.
//
// A triangle of degree d becomes three patches of bidegree d, which meet in its middle: a bilinear map of the
// square onto a third of the triangle preserves polynomials.
#include <functional>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// A four-sided patch.
struct LimitQuad {
  Index address = 0;
  CellCorners cell;  ///< cell that it is in
  std::int64_t cell_number = 0;
  int third = -1;                                  ///< corner of the triangle of which it is a third; -1: none
  std::array<std::array<double, 2>, 4> corners{};  ///< (u, v) in the address, counter-clockwise
  double size = 1;                                 ///< length of its sides, in edges of the mesh
  int degree = 1;
  Points net = {};  ///< Bernstein coefficients, the second parameter fastest
  bool is_exact = true;
  double volume = 0;  ///< contribution to the volume of a closed surface, set by `measure`

  /// Returns the address's parameters of a place in the quad's own parameters.
  Place place(double s, double t) const {
    Place at{address, 0, 0};
    const std::array<double, 4> w{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    for (size_t k = 0; k < 4; ++k) at.u += w[k] * corners[k][0], at.v += w[k] * corners[k][1];
    return at;
  }
};

/// Options of `limit_quads`.
struct LimitQuadOptions {
  double tolerance = 0;        ///< largest distance of caps from the limit, > 0
  bool join_smoothly = false;  ///< give caps common tangent planes with their exact neighbours; only for squares
  int most_rings = 14;         ///< largest number of rings around an extraordinary vertex
  std::function<void(int round)> progress;
};

/// All patches of a surface.
struct LimitQuads {
  std::vector<LimitQuad> quads;
  double deviation = 0;   ///< largest measured distance of points of caps from the limit
  std::int64_t caps = 0;  ///< number of fitted quads
  bool met = true;        ///< true if the deviation is within the tolerance
};

/// Returns the quads of a surface without its holes.
/// @param points  points of the surface's level, #V x 3
/// @throws InvalidParameter     points of another shape
/// @throws UnsupportedTopology  a scheme without polynomial pieces, pieces that are cut along a diagonal or whose
///                              children are no quarters
LimitQuads limit_quads(const LimitMap& surface, const Points& points, const LimitQuadOptions& options);

}  // namespace sublimit

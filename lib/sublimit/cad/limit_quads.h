// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface as four-sided Bezier patches: polynomial cells exactly, rings of them around extraordinary vertices,
// and a fitted cap for what is left in the middle of the rings, once it is near enough to the limit.
//
// A triangle of degree d becomes three patches of bidegree d, which meet in its middle: a bilinear map of the square
// onto a third of the triangle keeps polynomials.
#include <functional>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

struct LimitQuad {
  Index address = 0;
  CellCorners cell;  ///< that it is in
  std::int64_t cell_number = 0;
  int third = -1;                                  ///< of a triangle: the corner that it is at
  std::array<std::array<double, 2>, 4> corners{};  ///< in the address, counter-clockwise
  double size = 1;                                 ///< of its sides, in edges of the mesh
  int degree = 1;
  Points net = {};  ///< Bernstein coefficients, the second parameter fastest
  bool is_exact = true;
  double volume = 0;  ///< that it adds to what a closed surface bounds, once measured

  /// Returns the address's parameters of a place in the quad's own parameters.
  Place place(double s, double t) const {
    Place at{address, 0, 0};
    const std::array<double, 4> w{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    for (size_t k = 0; k < 4; ++k) at.u += w[k] * corners[k][0], at.v += w[k] * corners[k][1];
    return at;
  }
};

struct LimitQuadOptions {
  double tolerance = 0;        ///< of caps, > 0
  bool join_smoothly = false;  ///< caps and their exact neighbours, with common tangent planes; of squares
  int most_rings = 14;         ///< around an extraordinary vertex
  std::function<void(int round)> progress;
};

struct LimitQuads {
  std::vector<LimitQuad> quads;
  double deviation = 0;   ///< largest distance of points of caps from the limit, measured
  std::int64_t caps = 0;  ///< fitted quads
  bool met = true;        ///< the tolerance
};

/// Returns the quads of a surface without its holes.
/// @param points  of the level, #V x 3
/// @throws InvalidParameter     points that do not fit
/// @throws UnsupportedTopology  a scheme without polynomial pieces, pieces that are cut along a diagonal or whose
///                              children are no quarters
LimitQuads limit_quads(const LimitMap& surface, const Points& points, const LimitQuadOptions& options);

}  // namespace sublimit

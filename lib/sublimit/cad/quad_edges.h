// SPDX-License-Identifier: Apache-2.0
#pragma once
// Edges of four-sided patches: the parts of sides between the corners of all patches on them. They are shared
// by connectivity.
#include <vector>

#include "sublimit/cad/limit_quads.h"

namespace sublimit {

/// The part from `begin` to `end` of a side of a quad. Sides 0 to 3 are counter-clockwise; the parameter along
/// each is 0 to 1.
struct QuadSide {
  Index quad = 0;
  int side = 0;
  double begin = 0, end = 1;
  bool reversed = false;  ///< true if the side runs against the edge
};

/// An edge.
struct QuadEdge {
  Index start = 0, end = 0;  ///< vertices
  std::vector<QuadSide> uses = {};
  Points net = {};         ///< Bernstein coefficients
  double length = 0;       ///< length in edges of the mesh
  double gap = 0;          ///< distance from its sides, set by `measure`
  bool is_sharp = false;   ///< true on an infinitely sharp edge of the mesh, or a border
  bool is_smooth = false;  ///< true between two exact quads of equal size that are one B-spline with a simple knot here
};

/// All edges of quads.
struct QuadEdges {
  std::vector<QuadEdge> edges;
  std::vector<std::array<std::vector<Index>, 4>> sides;  ///< edges of each quad's sides, along its border
  Points vertices;
};

/// Returns the edges of the quads of a surface.
QuadEdges quad_edges(const LimitMap& surface, const std::vector<LimitQuad>& quads);

/// Returns the row in the net of coefficient (i, j) of the quad rotated such that corner `turn` is the first
/// one.
inline Eigen::Index turned_row(int degree, int turn, int i, int j) {
  const int d = degree;
  switch (turn & 3) {
    case 0:
      return i * (d + 1) + j;
    case 1:
      return (d - j) * (d + 1) + i;
    case 2:
      return (d - i) * (d + 1) + d - j;
    default:
      return j * (d + 1) + d - i;
  }
}

/// Returns the parameters in the quad of a place on a side.
inline std::array<double, 2> on_side(int side, double along) {
  switch (side) {
    case 0:
      return {along, 0};
    case 1:
      return {1, along};
    case 2:
      return {1 - along, 1};
    default:
      return {0, 1 - along};
  }
}

}  // namespace sublimit

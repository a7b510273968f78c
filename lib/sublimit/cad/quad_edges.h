// SPDX-License-Identifier: Apache-2.0
#pragma once
// Edges of four-sided patches: the parts of their sides between the corners of all patches that lie on them, each of
// them shared, by connectivity.
#include <vector>

#include "sublimit/cad/limit_quads.h"

namespace sublimit {

/// A part of a quad's side, 0 to 3 counter-clockwise, along the border from `begin` to `end`, 0 to 1.
struct QuadSide {
  Index quad = 0;
  int side = 0;
  double begin = 0, end = 1;
  bool reversed = false;  ///< against the edge
};

struct QuadEdge {
  Index start = 0, end = 0;  ///< vertices
  std::vector<QuadSide> uses = {};
  Points net = {};         ///< Bernstein coefficients
  double length = 0;       ///< in edges of the mesh
  double gap = 0;          ///< of the sides that use it, once measured
  bool is_sharp = false;   ///< an infinitely sharp edge of the mesh, or a border
  bool is_smooth = false;  ///< two exact quads of the same size, whose B-spline has a simple knot there
};

struct QuadEdges {
  std::vector<QuadEdge> edges;
  std::vector<std::array<std::vector<Index>, 4>> sides;  ///< edges of each quad's sides, along its border
  Points vertices;
};

QuadEdges quad_edges(const LimitMap& surface, const std::vector<LimitQuad>& quads);

/// Row of a net by local indices of a quad that is rotated so that its corner `turn` is the first one.
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

/// Returns the parameters in the quad of a place on its side.
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

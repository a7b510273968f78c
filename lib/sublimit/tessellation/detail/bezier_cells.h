// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface as Bezier cells: its polynomials as they are, each one cell; what is no polynomial, as around
// extraordinary vertices, cut until bilinear quadrilaterals (triangles) are within a distance that is proved.
//
// Polynomials that meet along the diagonal of a square, as those of mid-edge, become two triangles of twice the degree.
#include "sublimit/tessellation/detail/flat_cells.h"

namespace sublimit {

struct BezierCell {
  Index address = 0;
  CellCorners corners;  ///< of the cell's own (0, 0), (1, 0), (1, 1), (0, 1); of triangles (0, 0), (1, 0), (0, 1)
  bool triangle = false, exact = true;
  int degree = 0;  ///< in u and in v; of triangles the total one
  Points net;      ///< Bernstein coefficients by i, then j: i, j <= degree; of triangles i + j <= degree
};

struct BezierCells {
  std::vector<BezierCell> cells;  ///< in the order of addresses; holes are left out
  std::int64_t exact = 0;         ///< how many are
  double bound = 0;               ///< proved, for those that are not
};

/// @param chord      for cells that are not exact, > 0
/// @param max_cells  about
/// @throws InvalidParameter, UnsupportedTopology, ResourceError  as `flat_cells`
/// @note  Cells are not cut for the sake of their neighbours: a bilinear one meets a curved one within the chord.
BezierCells bezier_cells(const LimitMap& surface, const Points& control, double chord,
                         std::int64_t max_cells = std::int64_t{1} << 23);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit surfaces as Bezier cells: one exact cell per polynomial, and bilinear quadrilaterals (triangles) within
// a proved distance elsewhere, as around extraordinary vertices.
//
// Two polynomials that meet along the diagonal of a square, as in mid-edge schemes, become two triangles of
// twice the degree.
#include "sublimit/tessellation/detail/flat_cells.h"

namespace sublimit {

struct BezierCell {
  Index address = 0;
  CellCorners corners;  ///< corners (0, 0), (1, 0), (1, 1), (0, 1) of the cell; for triangles (0, 0), (1, 0), (0, 1)
  bool triangle = false, exact = true;
  int degree = 0;  ///< degree in u and in v; for triangles the total degree
  Points net;      ///< Bernstein coefficients by i, then j: i, j <= degree; for triangles i + j <= degree
};

struct BezierCells {
  std::vector<BezierCell> cells;  ///< cells by ascending address, without holes
  std::int64_t exact = 0;         ///< number of exact cells
  double bound = 0;               ///< proved distance of the others from the surface
};

/// Returns the cells of a surface.
/// @param chord      largest distance of cells that are not exact, > 0
/// @param max_cells  approximate limit of the number of cells
/// @throws InvalidParameter, UnsupportedTopology, ResourceError  see `flat_cells`
/// @note  Cells are not cut to match their neighbours: a bilinear cell meets a curved one only within the
///        chord.
BezierCells bezier_cells(const LimitMap& surface, const Points& control, double chord,
                         std::int64_t max_cells = std::int64_t{1} << 23);

}  // namespace sublimit

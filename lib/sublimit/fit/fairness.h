// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fairness of a surface as a quadratic form of its control points: thin plate energy, the integral over all faces
// of |xuu|^2 + 2 |xuv|^2 + |xvv|^2, and membrane energy, of |xu|^2 + |xv|^2, by Gauss quadrature with exact stencils.
//
//   const SparseMatrix H = fairness_energy(surface.map(), {.thin_plate = 1});
//   const double energy = (surface.points().transpose() * (H * surface.points())).trace();
//
// The parameters are natural ones: quadrilaterals are unit squares, triangles equilateral ones with unit sides, and the
// square at a corner of any other polygon has sides of 1/2, as a quarter of a quadrilateral has. So the energy does not
// depend on which corner of a face comes first, and the mesh after one step has the same membrane energy and a quarter
// of the thin plate energy. Patches have parameters of their own.
// Source: Halstead, Kass, DeRose 1993, "Efficient, fair interpolation using Catmull-Clark surfaces".
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// Weights of the energies, and accuracy of their integrals.
struct Fairness {
  double thin_plate = 0, membrane = 0;  ///< weights, >= 0
  /// Quadrature points along each side of a square or triangle, 1 to 8. Four are exact for bicubic and quartic pieces.
  /// No number is exact near extraordinary vertices: second derivatives may be unbounded there, though square
  /// integrable.
  int quadrature = 4;
  /// True if both weights are 0.
  bool empty() const { return thin_plate == 0 && membrane == 0; }
};

/// Returns H with energy = trace(x^T H x), over the control points of the surface; symmetric to the last bit, positive
/// semidefinite. Holes are left out. For schemes whose second derivatives jump (doo-sabin, mid-edge), squares are cut
/// at the jumps, as far as these are at the middle or on the diagonals. At a quadrature point without second
/// derivatives only membrane energy counts.
/// @throws InvalidParameter  weights that are negative or not finite, another number of quadrature points; thin plate
///                           energy of a surface that has second derivatives at no quadrature point (butterfly)
SparseMatrix fairness_energy(const LinearSource& surface, const Fairness& fairness);

}  // namespace sublimit

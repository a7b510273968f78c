// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fairness of a limit surface as a quadratic form of its control points: thin plate energy, the integral over all faces
// of |xuu|^2 + 2 |xuv|^2 + |xvv|^2, and membrane energy, of |xu|^2 + |xv|^2, by Gauss quadrature with exact stencils.
// Source: Halstead, Kass, DeRose 1993, "Efficient, fair interpolation using Catmull-Clark surfaces".
#include "sublimit/limit/limit_surface.h"

namespace sublimit {

struct Fairness {
  double thin_plate = 0, membrane = 0;  ///< weights, >= 0
  int quadrature = 3;                   ///< points a side of every square or triangle, 1 to 8
  bool empty() const { return thin_plate == 0 && membrane == 0; }
};

/// H, #V x #V over the vertices of the surface's level, symmetric, positive semidefinite: the energy is the trace of
/// x^T H x. Holes are left out; where second derivatives do not exist only membrane energy counts.
/// @throws InvalidParameter  negative weights, an unknown number of quadrature points
SparseMatrix fairness_energy(const LimitSurface& surface, const Fairness& fairness);

}  // namespace sublimit

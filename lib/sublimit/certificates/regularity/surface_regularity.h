// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scheme on regular meshes, analysed from its one mask: polynomials, smoothness, support, what a new point costs.
// Tensor products of curve masks are as smooth as their curves; of others the differences decide, all directions
// together.
#include "sublimit/certificates/regularity/curve_regularity.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

struct [[nodiscard]] SurfaceRegularity {
  RegularMask<Rational> mask;
  bool tensor = false;  ///< the product of two curve masks
  int sum_rules = 0;    ///< polynomials of total degree below this are generated
  PolynomialDegrees degrees;
  Smoothness smoothness;
  /// Convex hull of where the basis function is not zero, steps from its point, counter-clockwise in grid coordinates.
  std::vector<std::array<Rational, 2>> outline;
  bool positive = false, interpolates = false;
  std::vector<PointCost> costs;  ///< of the new points of a period, one for each residue
  std::vector<Verdict> verdicts;
};

/// @param options  how much effort goes into joint spectral radii
SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask, const JointSpectralRadiusOptions& options);
SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask);

/// True if the child of every old vertex of a regular mesh is the vertex itself.
bool keeps_vertices(const RegularMask<Rational>& mask);

/// The curve masks whose product a mask is; nothing if it is none.
std::optional<std::array<Symbol, 2>> tensor_factors(const RegularMask<Rational>& mask);

/// Samples of the basis function at the points of some levels, in floating-point numbers: x and y in grid steps from
/// its point, heights by row.
struct SurfaceSamples {
  std::vector<double> x, y;
  std::vector<std::vector<double>> values;  ///< values[j][i] at (x[i], y[j])
};
SurfaceSamples basis_samples(const RegularMask<Rational>& mask, int levels);

}  // namespace sublimit

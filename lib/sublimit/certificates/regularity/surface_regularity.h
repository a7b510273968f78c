// SPDX-License-Identifier: Apache-2.0
#pragma once
// Analysis of schemes on regular meshes from their mask: polynomials, smoothness, support, points per mask.
// Tensor products of curve masks are as smooth as the curves; for other masks differences in all directions are
// analysed together.
#include "sublimit/certificates/regularity/curve_regularity.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// Result of the analysis.
struct [[nodiscard]] SurfaceRegularity {
  RegularMask<Rational> mask;
  bool tensor = false;  ///< true if the mask is the product of two curve masks
  int sum_rules = 0;    ///< polynomials of total degree below this are generated
  PolynomialDegrees degrees;
  Smoothness smoothness;
  /// Convex hull of the support of the basis function, in grid steps from its point, counter-clockwise.
  std::vector<std::array<Rational, 2>> outline;
  bool positive = false, interpolates = false;
  std::vector<PointCost> costs;  ///< points per mask of the new points of a period, for each residue
  std::vector<Verdict> verdicts;
};

/// Returns the analysis of a mask.
/// @param options  effort of joint spectral radii
SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask, const JointSpectralRadiusOptions& options);
SurfaceRegularity surface_regularity(const RegularMask<Rational>& mask);

/// True if the child of every old vertex of a regular mesh is the vertex itself.
bool keeps_vertices(const RegularMask<Rational>& mask);

/// Returns the curve masks whose product a mask is; nothing if it is no product.
std::optional<std::array<Symbol, 2>> tensor_factors(const RegularMask<Rational>& mask);

/// Samples of the basis function at the points of some levels, in floating-point numbers: x and y in grid steps from
/// its point, heights by row.
struct SurfaceSamples {
  std::vector<double> x, y;
  std::vector<std::vector<double>> values;  ///< values[j][i] at (x[i], y[j])
};
SurfaceSamples basis_samples(const RegularMask<Rational>& mask, int levels);

}  // namespace sublimit

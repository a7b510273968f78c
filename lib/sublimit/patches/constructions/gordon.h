// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gordon surfaces: surfaces through a network of intersecting curves along u and along v, as the boolean sum
// L_u + L_v - L_uv of the interpolating surfaces of both families and of their intersections (boolean_sum.h).
// With polynomial (Lagrange) or spline blending functions the surface is a spline. Source: Gordon 1969,
// "Spline-blended surface interpolation through curve networks"; Piegl, Tiller 1997, section 10.5.
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Blending functions.
enum class GordonBlending {
  lagrange,  ///< polynomials of degree #curves - 1: for few curves
  spline,    ///< interpolating splines, cubic where there are 4 curves or more, knots by averaging
};
/// Names of the blendings in files.
inline constexpr const char* gordon_blending_words[] = {"lagrange", "spline"};

/// A network of curves.
struct GordonNetwork {
  std::vector<CurveNet> curves_u;    ///< S(u, parameters_v[l])
  std::vector<CurveNet> curves_v;    ///< S(parameters_u[k], v)
  std::vector<double> parameters_u;  ///< one for each of curves_v, ascending, in the domain of curves_u
  std::vector<double> parameters_v;
};

/// Returns the largest distance between two curves at their common parameters.
double network_gap(const GordonNetwork& network);

/// Returns the Gordon surface of a network.
/// @param tolerance  largest distance of curves that should meet; < 0: 1e-9 of the size of the data
/// @throws InvalidParameter  wrong counts, parameters outside the domain or not ascending, rational curves,
///                           more than max_degree + 1 curves with Lagrange blending
/// @throws InvalidMesh       curves that do not meet, naming them and the gap
SplineNet gordon(const GordonNetwork& network, GordonBlending blending, double tolerance = -1);

}  // namespace sublimit

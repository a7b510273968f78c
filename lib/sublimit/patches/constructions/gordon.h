// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gordon surfaces: through a network of curves along u and along v that meet, as the boolean sum L_u + L_v - L_uv of
// the interpolating surfaces of both families and of their intersections (boolean_sum.h). With polynomials (Lagrange)
// or splines as blending functions the surface is a spline. Source: Gordon 1969, "Spline-blended surface interpolation
// through curve networks"; Piegl, Tiller 1997, section 10.5.
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

enum class GordonBlending {
  lagrange,  ///< polynomials of degree #curves - 1: for few curves
  spline,    ///< interpolating splines, cubic where there are 4 curves or more, knots by averaging
};
/// Names of the blendings in files.
inline constexpr const char* gordon_blending_words[] = {"lagrange", "spline"};

struct GordonNetwork {
  std::vector<CurveNet> curves_u;    ///< S(u, parameters_v[l])
  std::vector<CurveNet> curves_v;    ///< S(parameters_u[k], v)
  std::vector<double> parameters_u;  ///< one for each of curves_v, rising, in the domain of curves_u
  std::vector<double> parameters_v;
};

/// Returns the largest distance of curves that should meet.
double network_gap(const GordonNetwork& network);

/// @param tolerance  where curves meet; < 0: 1e-9 of the size of the data
/// @throws InvalidParameter  counts, parameters outside the domain or not rising, rational curves, more than
///                           max_degree + 1 curves of Lagrange blending
/// @throws InvalidMesh       curves that do not meet, naming them and the gap
SplineNet gordon(const GordonNetwork& network, GordonBlending blending, double tolerance = -1);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits on regular meshes, and the splines that they should equal, evaluated by recursions without refinement.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/scheme/scheme.h"
#include "truth/precise.h"

namespace sublimit::testing {

/// Returns the uniform B-spline centred at 0, by the recursion of Cox and de Boor.
double cardinal_bspline(int degree, double x);

/// Box spline centred at 0, by the recursion of de Boor and Hoellig, for different directions in the integer
/// plane.
class BoxSpline {
 public:
  using Directions = std::vector<std::pair<int, int>>;
  BoxSpline(Directions directions, std::vector<int> multiplicities);
  double operator()(double x, double y) const;
  /// Returns the value at a point strictly inside a polynomial piece.
  Precise inside(const Precise& x, const Precise& y) const;

 private:
  Directions directions_;
  std::vector<int> multiplicities_;
};

/// The limit surface phi of one control point, as a function of the position relative to this point.
using Generator = std::function<double(double x, double y)>;

/// Compares the limits of the vertices of levels 0, 1 and 2 of a regular torus (triangles: with edges (1,0),
/// (0,1) and (1,1)) with sums of phi(place - control point) over the control points. Returns the largest
/// difference of a weight.
double regular_limit_error(const Scheme<double>& scheme, const Generator& phi);

/// Returns the largest degree up to 10 whose polynomials, sampled at the vertices of a flat regular mesh, are
/// reproduced by the limit.
int reproduced_degree(const Scheme<double>& scheme);

/// Returns the largest degree whose polynomials have limits that are polynomials with the same leading terms.
int generated_degree(const Scheme<double>& scheme);

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits on regular meshes, and the splines that they should be, evaluated by recursions that know no refinement.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/scheme/scheme.h"
#include "support/precise.h"

namespace sublimit::testing {

/// Uniform B-spline with its middle at 0, by Cox and de Boor.
double cardinal_bspline(int degree, double x);

/// Box spline with its middle at 0, by the recursion of de Boor and Hoellig; directions of the integer plane, none
/// twice.
class BoxSpline {
 public:
  using Directions = std::vector<std::pair<int, int>>;
  BoxSpline(Directions directions, std::vector<int> multiplicities);
  double operator()(double x, double y) const;
  /// Strictly inside one of its polynomial pieces.
  Precise inside(const Precise& x, const Precise& y) const;

 private:
  Directions directions_;
  std::vector<int> multiplicities_;
};

/// phi of a control point's limit surface, from the control point.
using Generator = std::function<double(double x, double y)>;

/// Limits of the vertices of levels 0, 1 and 2 of a regular torus (triangles: with edges (1,0), (0,1) and (1,1))
/// against sums of phi(place - control point) over the control points: the largest difference of a weight.
double regular_limit_error(const Scheme<double>& scheme, const Generator& phi);

/// The largest degree up to 10 whose polynomials, taken at the places of a flat regular mesh, are the limits of their
/// own values.
int reproduced_degree(const Scheme<double>& scheme);

/// The same where the limits are other polynomials with the same leading terms.
int generated_degree(const Scheme<double>& scheme);

}  // namespace sublimit::testing

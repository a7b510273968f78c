// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface through a cloud of points: project every point onto the surface, fit the control points to where the
// projections should be, and again. The measure
//
//   E(x) = mean of w_i distance(q_i, surface of x)^2 + fairness(x)
//
// never rises: with projections kept, the fit can only lower the sum, and new projections can only lower it again.
//
// That is slow where points have to slide along the surface. So the part of each distance along the surface counts
// less, as in tangent distance minimisation: ever less while E falls, as in the method of Levenberg and Marquardt; a
// step that raises E is taken again with more of it, at last all. Source: Pottmann, Leopoldseder 2003, "A concept for
// parametric surface fitting which avoids the parametrization problem"; Hoppe et al. 1994, "Piecewise smooth surface
// reconstruction", for fits of subdivision surfaces.
#include <functional>

#include "sublimit/fit/cloud.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/search/closest_point.h"

namespace sublimit {

struct CloudIteration {
  double rms = 0, largest = 0;  ///< distances: root of the weighted mean square; maximum
  double energy = 0;            ///< E, with the fairness of this iteration
  double fairness = 1;          ///< the factor that it had
};

struct CloudFitOptions {
  Fairness fairness = {};
  /// Factors of fairness, one an iteration; the last one stays. Empty: 1. Falling ones find the way from far off.
  std::vector<double> schedule = {};
  /// What the part of a distance along the surface counts, in (0, 1]; 1: distances from points, not from tangent
  /// planes.
  double tangential = 0.1;
  Pins pins = {};
  int max_iterations = 50;
  double tolerance = 1e-6;  ///< stops when E falls by less, relative to it, at the end of the schedule
  FitSolverOptions solver = {};
  /// Told after every iteration: its number, 0 for the first guess, and how far the points are.
  std::function<void(int, const CloudIteration&)> progress = {};
};

struct [[nodiscard]] CloudFit {
  Points points;                           ///< control points, #V x 3
  std::vector<CloudIteration> iterations;  ///< the first guess before them
  ClosestPoints feet;                      ///< of the cloud's points on the result
  bool converged = false;                  ///< to the tolerance
};

/// Control points near to a first guess, whose surface is near to the points. What no point sees stays as it is.
/// @param guess  #V x 3
/// @throws InvalidParameter  no points, shapes that do not fit, numbers that are not finite, negative weights or
///                           factors; and as `fit_places` does
/// @throws InvalidMesh       no face that is not a hole
CloudFit fit_cloud(const LimitMap& surface, const Cloud& cloud, const Points& guess,
                   const CloudFitOptions& options = {});

}  // namespace sublimit

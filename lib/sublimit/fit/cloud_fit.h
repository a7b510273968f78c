// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fits a limit surface, or classical patches, to a cloud of points: projects every point onto the surface, fits the
// control points to where the projections should be, and repeats this.
//
//   const LimitSurface start(read_mesh("box.obj"), "catmull-clark");
//   const Cloud cloud = cloud_of_vertices(read_mesh("scan.ply"));
//   const CloudFit fitted = fit_cloud(start.map(), cloud, start.points(), {.fairness = {.thin_plate = 1e-4}});
//   const LimitSurface result = start.with(fitted.points);
//
// The measure
//
//   E(x) = mean of w_i distance(q_i, surface of x)^2 + fairness(x)
//
// never rises: with projections kept, the fit can only lower the sum, and new projections can only lower it again.
//
// That is slow where points have to slide along the surface. So the tangential part of each distance counts less, as in
// tangent distance minimisation. Its factor decreases while E falls, as in the method of Levenberg and Marquardt; a
// step that raises E is repeated with a larger factor, up to 1. Source: Pottmann, Leopoldseder 2003, "A concept for
// parametric surface fitting which avoids the parametrization problem"; Hoppe et al. 1994, "Piecewise smooth surface
// reconstruction", for fits of subdivision surfaces.
#include <functional>

#include "sublimit/fit/cloud.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/patches/patches.h"
#include "sublimit/search/closest_point.h"

namespace sublimit {

/// Statistics of one iteration.
struct CloudIteration {
  double rms = 0, largest = 0;  ///< distances: root of the weighted mean square; maximum
  double energy = 0;            ///< E, with the fairness of this iteration
  double fairness = 1;          ///< factor of fairness in this iteration
};

/// Options of `fit_cloud`.
struct CloudFitOptions {
  Fairness fairness = {};
  /// Factors of fairness, one for each iteration; the last one is kept. Empty: 1. A decreasing schedule converges from
  /// a distant first guess.
  std::vector<double> schedule = {};
  /// Factor of the tangential part of distances, in (0, 1]; 1: distances from points instead of tangent planes.
  double tangential = 0.1;
  Pins pins = {};           ///< control points with given positions
  int iterations = 50;      ///< largest number of iterations
  double tolerance = 1e-6;  ///< stops when E decreases by less, relative to E, at the end of the schedule
  FitSolverOptions solver = {};
  /// Called after every iteration, if given: its number, 0 for the first guess, and its statistics.
  std::function<void(int, const CloudIteration&)> progress = {};
};

/// Result of `fit_cloud`.
struct [[nodiscard]] CloudFit {
  Points points;                           ///< control points, as those of the first guess
  std::vector<CloudIteration> iterations;  ///< statistics of the first guess, then of each iteration
  ClosestPoints foot_points;               ///< the points of the result nearest to those of the cloud
  bool converged = false;                  ///< true if E became stationary to the tolerance
};

/// Returns control points near a first guess, whose surface is near the cloud. Control points that no point of the
/// cloud depends on keep their position.
/// @param guess  control points to start from, #V x 3
/// @throws InvalidParameter  no points, shapes that do not fit, numbers that are not finite, negative weights or
///                           factors, pins as in `fit_places`
/// @throws InvalidMesh       no face that is not a hole
CloudFit fit_cloud(const LimitMap& surface, const Cloud& cloud, const Points& guess,
                   const CloudFitOptions& options = {});
/// Returns control points of patches, from those that they have. Weights of rational patches are kept.
/// @return  `points` as those of the patches: #points x 3, or x 4 if they are homogeneous
/// @throws InvalidParameter  as for limits; a control point of weight 0
CloudFit fit_cloud(const Patches& guess, const Cloud& cloud, const CloudFitOptions& options = {});

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fits control points by least squares, so that the limit comes as near as possible to given points at given places:
//
//   const PlaceTargets targets = {.places = {{.face = 0, .u = 0.5, .v = 0.5}}, .values = Points{{0, 0, 1}}};
//   const ScatteredFit fitted = fit_places(surface.map(), targets, surface.points());
//   const LimitSurface result = surface.with(fitted.points);
//
// The result solves
//
//   min  sum_i w_i |x(face_i, u_i, v_i) - b_i|^2 + fairness(x)    subject to    x_j = d_j for pinned control points.
//
// Places are rows of exact stencils, so this is linear, in any number of channels.
#include <optional>

#include "sublimit/fit/conditioning.h"
#include "sublimit/fit/fairness.h"
#include "sublimit/fit/fit_problem.h"
#include "sublimit/fit/targets.h"

namespace sublimit {

/// Control points with given values.
struct Pins {
  std::vector<Index> vertices;  ///< numbers of the control points
  Points values = {};           ///< #vertices x channels; empty: the values of the first guess
};

/// Options of `fit_places`.
struct ScatteredFitOptions {
  Fairness fairness = {};  ///< empty: of all best fits the one nearest to the first guess
  Pins pins = {};
  FitSolverOptions solver = {};
  bool conditioning = false;  ///< compute rank and singular values too, which takes time on large meshes
};

/// Result of `fit_places`.
struct [[nodiscard]] ScatteredFit {
  Points points;                ///< control points, #control points x channels
  FitSolution solution;         ///< statistics of solving
  Eigen::VectorXd residuals;    ///< distance |x - b| by target, including targets of weight 0
  double rms = 0, largest = 0;  ///< of the residuals: root of the weighted mean square; maximum
  /// If asked for: conditioning of the rows of targets with weight and of pinned points, without weights and fairness.
  /// With a rank below #control points, what the targets leave free is decided by fairness, or stays near the first
  /// guess.
  std::optional<Conditioning> conditioning;
};

/// Finds control points whose surface is near given points at given places.
/// @param surface  any linear source: the limit of a scheme, patches, rational patches with fixed weights
/// @param guess    #control points x channels; decides what the targets leave free
/// @throws InvalidParameter  a place on no face, outside its face or on a hole, numbers that are not finite, negative
///                           weights: says which row; a pin on no vertex, or two on one; shapes that do not fit
/// @throws ResourceError     more memory than there is
ScatteredFit fit_places(const LinearSource& surface, const PlaceTargets& targets, const Points& guess,
                        const ScatteredFitOptions& options = {});

/// Returns the weights of positions at places, #places x #control points.
/// @throws InvalidParameter  a place on no face, outside its face or on a hole: says which row
SparseMatrix place_rows(const LinearSource& surface, const std::vector<Place>& places);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Least squares: control points whose limit comes as near as possible to given points at given places,
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

/// Control points that are known.
struct Pins {
  std::vector<Index> vertices;
  Points values = {};  ///< #vertices x channels; empty: where the first guess has them
};

struct ScatteredFitOptions {
  Fairness fairness = {};  ///< empty: of all best fits the one nearest to the first guess
  Pins pins = {};
  FitSolverOptions solver = {};
  bool conditioning = false;  ///< rank and singular values: time, on large meshes
};

struct [[nodiscard]] ScatteredFit {
  Points points;                ///< control points, #control points x channels
  FitSolution solution;         ///< how they were found
  Eigen::VectorXd residuals;    ///< distance |x - b| by target, those of weight 0 too
  double rms = 0, largest = 0;  ///< of them: root of the weighted mean square; maximum
  /// If asked for: of the rows of targets with weight and of pinned points, without weights and fairness. Fewer
  /// than #V: what the targets leave free is told by fairness, or stays near the first guess.
  std::optional<Conditioning> conditioning;
};

/// @param surface  any source: the limit of a scheme, patches, rational ones whose weights stay (weighted_source.h)
/// @param guess    #control points x channels: what the result stays near to, where the targets do not say
/// @throws InvalidParameter  says which row: a place on no face, outside its face or on a hole, numbers that are not
///                           finite, negative weights; a pin on no vertex, or two on one; shapes that do not fit
/// @throws ResourceError     more memory than there is
ScatteredFit fit_places(const LinearSource& surface, const PlaceTargets& targets, const Points& guess,
                        const ScatteredFitOptions& options = {});

/// Position rows of places, #places x #control points.
/// @throws InvalidParameter  as `fit_places` does
SparseMatrix place_rows(const LinearSource& surface, const std::vector<Sample>& places);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Large linear systems of fits.
#include <functional>
#include <string>
#include <vector>

#include "sublimit/fit/fit_problem.h"

namespace sublimit::bench {

struct FitSystem {
  std::string name, what;
  std::function<FitProblem()> make;
};

/// Returns systems on tori of about `vertices` control points:
///
///     points    Catmull-Clark through a point for each control point: square
///     normals   points and normals of a quarter as many vertices, refined once: fewer conditions than unknowns, one
///               channel
///     fairness  points of a quarter as many vertices, refined once, with the least thin plate energy
///     places    least squares at four random places for each control point
std::vector<FitSystem> fit_systems(Index vertices);

}  // namespace sublimit::bench

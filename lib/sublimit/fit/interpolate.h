// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points whose limit passes through given points with given normals, for every linear scheme: position rows are
// limit masks, a normal N gives the rows N . (T_1 x) = 0 and N . (T_2 x) = 0 of both tangent masks.
//
// As many points as control points make a square system, which can be singular (a cube's is, exactly). Normals need
// more freedom: the mesh is refined once, and of all control points of level 1 that meet the conditions those are taken
// that are fairest, or nearest to the refined mesh. Source: Halstead, Kass, DeRose 1993, "Efficient, fair interpolation
// using Catmull-Clark surfaces".
#include "sublimit/fit/conditioning.h"
#include "sublimit/fit/fairness.h"
#include "sublimit/fit/fit_problem.h"
#include "sublimit/fit/targets.h"
#include "sublimit/refine.h"

namespace sublimit {

/// Whether control points may be added by one refinement.
enum class Freedom {
  none,       ///< never
  automatic,  ///< where the conditions cannot be met without
  refine,     ///< always
};

struct InterpolationOptions {
  Freedom freedom = Freedom::automatic;
  Fairness fairness = {};  ///< empty: the control points nearest to those given (refined, if need be)
  FitSolverOptions solver = {};
  SubdivisionOptions rules = {};
  bool conditioning = true;  ///< rank and singular values: time, on large meshes
};

struct Interpolation {
  Level level;           ///< 0, or 1 where freedom was added; of primal schemes its first vertices are the given mesh's
  Points points;         ///< its control points
  FitSolution solution;  ///< how they were found
  Conditioning conditioning;          ///< of all conditions
  bool solved = false;                ///< residuals are at the level of rounding
  Eigen::VectorXd position_residual;  ///< distance, by target
  Eigen::VectorXd normal_residual;    ///< radians, by target, the largest of its sides; NaN without a normal
  std::vector<Index> undetermined;    ///< vertices that singular conditions leave free
  std::vector<Index> contradictory;   ///< vertices whose targets contradict each other or the scheme's rules
};

/// A normal holds on every side of its vertex.
/// @param mesh     its positions are the first guess
/// @throws InvalidParameter  a vertex that does not exist, two targets on one vertex, an isolated vertex, a normal of
/// zero
///                           length, numbers that are not finite; or Freedom::none and no solution: says which vertices
/// @throws InvalidMesh, UnsupportedTopology  as refinement does
Interpolation interpolate(const Scheme<double>& scheme, const ControlMesh& mesh,
                          const std::vector<VertexTarget>& targets, const InterpolationOptions& options = {});

}  // namespace sublimit

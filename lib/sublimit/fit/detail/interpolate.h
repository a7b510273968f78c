// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points whose limit interpolates given points with given normals, for any linear scheme. Position rows
// are limit masks; a normal N gives the rows N . (T_1 x) = 0 and N . (T_2 x) = 0 of both tangent masks.
//
// As many points as control points give a square system, which can be singular (that of a cube is). Normals
// need more unknowns: the mesh is refined, once if that suffices. Among all control points of the level that
// satisfy the conditions, the fairest ones are chosen, or those nearest to a first guess: the given control
// points, corrected by the distance of their limit from the targets, and refined. Source: Halstead, Kass,
// DeRose 1993, "Efficient, fair interpolation using Catmull-Clark surfaces".
#include <string>

#include "sublimit/fit/conditioning.h"
#include "sublimit/fit/fairness.h"
#include "sublimit/fit/fit_problem.h"
#include "sublimit/fit/targets.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Options of `interpolate`.
struct InterpolationOptions {
  /// Range of the number of refinements; the least one that meets the conditions is used. Only multiples of the
  /// scheme's period are tried: levels between them (mid-edge, sqrt3) are no control meshes.
  int least_refinements = 0, most_refinements = 2;
  Fairness fairness = {};  ///< fairness to minimise; empty: distance from the first guess
  FitSolverOptions solver = {};
  SubdivisionOptions rules = {};
  bool conditioning = true;  ///< compute rank and singular values, which takes time on large meshes
};

/// An attempt with a number of refinements.
struct InterpolationAttempt {
  int refinements = 0;
  Index unknowns = 0, conditions = 0;     ///< number of scalar unknowns and conditions; without normals per coordinate
  double position_error = 0;              ///< largest distance from a target
  double normal_error = 0;                ///< largest angle from a normal, radians
  bool solved = false;                    ///< true if errors are of the size of rounding
  Conditioning conditioning = {};         ///< conditioning of the conditions, if requested
  std::vector<Index> undetermined = {};   ///< vertices that a singular square system leaves free
  std::vector<Index> contradictory = {};  ///< vertices whose targets the control points cannot meet
};

/// Result of `interpolate`.
struct [[nodiscard]] Interpolation {
  /// Level of the control points. Its first vertices are those of the given mesh, in order, if the scheme keeps
  /// vertices.
  Level level;
  Points points;                               ///< its control points
  FitSolution solution;                        ///< report of the solver, without x
  std::vector<InterpolationAttempt> attempts;  ///< all attempts; the last one is the result
  Eigen::VectorXd position_error;              ///< distance by target
  Eigen::VectorXd normal_error;                ///< radians by target, largest of its sides; NaN without a normal
  /// Targets whose normal is ignored, since the scheme has no tangent plane at the vertex, or only holes are
  /// around it.
  std::vector<Index> without_plane;
  [[nodiscard]] bool solved() const { return attempts.back().solved; }
};

/// Returns control points whose limit interpolates the targets.
///
/// A normal applies to every side of its vertex. Vertices without a target stay as close to the guess as the
/// others allow.
/// @param mesh  its positions are the first guess
/// @return  if the conditions cannot be met, a least-squares solution: `solved()` is false, and the last
///          attempt names the vertices
/// @throws InvalidParameter  a vertex that does not exist, is in no face or only in holes, or has two targets;
///                           a normal of zero length, numbers that are not finite, a decreasing range of
///                           refinements
/// @throws InvalidMesh, UnsupportedTopology, AnalysisError, ResourceError  see refinement and limits
Interpolation interpolate(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<VertexTarget>& targets,
                          const InterpolationOptions& options = {});

/// Returns the first few vertices of a list, in words.
std::string listed_vertices(const std::vector<Index>& vertices);

/// Returns the reason why an attempt failed, in words: which vertices, and what would be right.
std::string why_unsolved(const InterpolationAttempt& attempt);

}  // namespace sublimit

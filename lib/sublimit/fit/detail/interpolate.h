// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points whose limit passes through given points with given normals, for every linear scheme: position rows are
// limit masks, a normal N gives the rows N . (T_1 x) = 0 and N . (T_2 x) = 0 of both tangent masks.
//
// As many points as control points make a square system, which can be singular (a cube's is, exactly). Normals need
// more freedom: the mesh is refined, once if that is enough, and of all control points of that level that meet the
// conditions those are taken that are fairest, or nearest to a first guess: the given control points, moved by what
// their limit misses, and refined. Source: Halstead, Kass, DeRose 1993, "Efficient, fair interpolation using
// Catmull-Clark surfaces".
#include <string>

#include "sublimit/fit/conditioning.h"
#include "sublimit/fit/fairness.h"
#include "sublimit/fit/fit_problem.h"
#include "sublimit/fit/targets.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

struct InterpolationOptions {
  /// Refinements, each of which adds control points: as few as meet the conditions. The same number twice asks for that
  /// one; 0 and 0 add none. Multiples of the scheme's period count: levels between them (of mid-edge, sqrt3) are no
  /// control meshes.
  int least_refinements = 0, most_refinements = 2;
  Fairness fairness = {};  ///< empty: nearest to the first guess
  FitSolverOptions solver = {};
  SubdivisionOptions rules = {};
  bool conditioning = true;  ///< rank and singular values: time, on large meshes
};

/// An attempt with a number of refinements.
struct InterpolationAttempt {
  int refinements = 0;
  Index unknowns = 0, conditions = 0;     ///< scalar ones; points alone: per coordinate
  double position_error = 0;              ///< largest distance
  double normal_error = 0;                ///< largest angle, radians
  bool solved = false;                    ///< errors at the level of rounding
  Conditioning conditioning = {};         ///< of the conditions, if asked for
  std::vector<Index> undetermined = {};   ///< vertices that a singular square system leaves free
  std::vector<Index> contradictory = {};  ///< vertices whose targets the control points cannot meet
};

struct [[nodiscard]] Interpolation {
  Level level;    ///< whose limit it is; of schemes that keep vertices the first ones are the given mesh's, in order
  Points points;  ///< its control points
  FitSolution solution;                        ///< how they were found; without x
  std::vector<InterpolationAttempt> attempts;  ///< the last one is this
  Eigen::VectorXd position_error;              ///< distance, by target
  Eigen::VectorXd normal_error;                ///< radians, by target, the largest of its sides; NaN without a normal
  /// Targets with a normal at vertices where the scheme has no tangent plane, or only holes around: it is left out.
  std::vector<Index> without_plane;
  [[nodiscard]] bool solved() const { return attempts.back().solved; }
};

/// A normal holds on every side of its vertex. Vertices without a target stay as near to the guess as the others allow.
/// @param mesh  its positions are the first guess
/// @return  also where the conditions cannot be met: nearest in the sense of least squares, `solved()` is false and the
///     last attempt names the vertices
/// @throws InvalidParameter  a vertex that does not exist, is in no face or in holes alone, or has two targets; a
///                           normal of zero length, numbers that are not finite, numbers of refinements out of
///                           order
/// @throws InvalidMesh, UnsupportedTopology, AnalysisError, ResourceError  as refinement and limits do
Interpolation interpolate(const Scheme<double>& scheme, const Mesh& mesh, const std::vector<VertexTarget>& targets,
                          const InterpolationOptions& options = {});

/// Returns the first few vertices of a list, in words.
std::string listed_vertices(const std::vector<Index>& vertices);

/// Returns the reason why an attempt failed, in words: which vertices, and what would be right.
std::string why_unsolved(const InterpolationAttempt& attempt);

}  // namespace sublimit

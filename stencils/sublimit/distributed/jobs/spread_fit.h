// SPDX-License-Identifier: Apache-2.0
#pragma once
// Least squares of a mesh that no process has whole: control points whose limit comes as near as possible to given
// points at given places, or goes through given points at vertices. The terms are those of `fit_places`
// (scattered_fit.h):
//
//   min  sum_i w_i |x(face_i, u_i, v_i) - b_i|^2 + fairness(x)
//
// Without fairness by LSQR on the rows, which from the first guess ends at the nearest one of all best fits; with
// fairness by conjugate gradients on A^T W A + H, preconditioned by algebraic multigrid; what that leaves free stays
// near the first guess, by a measure that depends on the preconditioner. Both are PETSc's. Source: Paige, Saunders
// 1982, "LSQR: an algorithm for sparse linear equations and sparse least squares".
#include <filesystem>
#include <functional>

#include "sublimit/distributed/jobs/spread_targets.h"
#include "sublimit/fit/fairness.h"

namespace sublimit {

struct SpreadFitRequest {
  Fairness fairness = {};
  double tolerance = 1e-14;   ///< of the gradient, relative to the data
  int max_iterations = 2000;  ///< of each coordinate
  bool best_effort = false;   ///< what did not converge, or does not meet its targets, is a result too
  std::string petsc = {};     ///< options of PETSc's solvers
};

struct SpreadFit {
  std::vector<double> points;       ///< control points of the own run, interleaved
  std::int64_t num_targets = 0;     ///< of the whole, like all that follows
  std::array<int, 3> iterations{};  ///< of each coordinate; of all at once the first
  double gradient = 0;              ///< the largest one of them, relative to the data
  bool converged = false;           ///< to the tolerance
  std::string reason;               ///< why the last iterations ended, as PETSc calls it
  double rms = 0, largest = 0;      ///< distances of limit and targets: root mean square; maximum
  double box = 1;                   ///< diagonal of the targets' bounding box, or of the mesh's, > 0
  std::string method;               ///< as PETSc calls it: lsqr, cg, ...
  std::vector<std::string> unused;  ///< options of PETSc that had no effect
};

/// All ranks call.
/// @param told  what is being done, on the first rank
/// @throws FormatError    what `SpreadTargets` refuses; a target on a hole
/// @throws InvalidOption  fairness and targets at vertices, options of PETSc that cannot be read
/// @throws InvalidMesh    targets at vertices that are not met, unless `best_effort`
/// @throws AnalysisError  a fit that did not converge, unless `best_effort`: says how far it came
/// @throws InvalidParameter, ResourceError, ...  as `fairness_energy`, `place_rows`; all of these on all ranks
SpreadFit fit(const Ranks& ranks, const SpreadJob& job, SpreadTargets& targets, const SpreadFitRequest& request,
              const std::function<void(const std::string&)>& told);

/// Control points as .npy, or as .ply with the faces of their mesh.
/// @param points  of the own run, interleaved
/// @throws IoError, ResourceError, InvalidOption  on all ranks
void write_control_points(const Ranks& ranks, const SpreadMesh& mesh, std::span<const double> points,
                          const std::filesystem::path& path);

}  // namespace sublimit

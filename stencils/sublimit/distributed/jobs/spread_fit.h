// SPDX-License-Identifier: Apache-2.0
#pragma once
// Least squares of a mesh that no process has whole: control points whose limit comes as near as possible to given
// points at given places, or goes through given points at vertices. The terms are those of `fit_places`
// (scattered_fit.h):
//
//   min  sum_i w_i |x(face_i, u_i, v_i) - b_i|^2 + fairness(x)
//
// Solvers are PETSc's. Without fairness it is LSQR on the rows, which converges to the best fit that is nearest
// to the first guess (the control points of the mesh). With fairness it is conjugate gradients on A^T W A + H
// with algebraic multigrid as preconditioner; components that the system does not determine stay near the first
// guess, in a norm that depends on the preconditioner. Source: Paige, Saunders 1982, "LSQR: an algorithm for
// sparse linear equations and sparse least squares".
#include <filesystem>
#include <functional>

#include "sublimit/distributed/jobs/spread_targets.h"
#include "sublimit/fit/fairness.h"

namespace sublimit {

struct SpreadFitRequest {
  Fairness fairness = {};
  double tolerance = 1e-14;   ///< largest gradient, relative to the data
  int max_iterations = 2000;  ///< most iterations for each coordinate
  bool best_effort = false;   ///< return fits that did not converge or do not meet their targets
  std::string petsc = {};     ///< options for PETSc's solvers: "-name value -name"
};

struct SpreadFit {
  std::vector<double> points;       ///< control points of this rank's run, interleaved
  std::int64_t num_targets = 0;     ///< targets of all ranks; the fields below are of all ranks, too
  std::array<int, 3> iterations{};  ///< by coordinate; without fairness all are solved at once: the first
  double gradient = 0;              ///< largest gradient of the solved systems, relative to the data
  bool converged = false;           ///< true if `gradient` is within the tolerance
  std::string reason;               ///< PETSc's word for why the last iterations ended
  double rms = 0, largest = 0;      ///< distances of the limit from the targets
  double box = 1;                   ///< diagonal of the targets' bounding box, or of the mesh's, > 0
  std::string method;               ///< PETSc's name of the solver: lsqr, cg, ...
  std::vector<std::string> unused;  ///< options of PETSc that had no effect
};

/// Fits the control points of a mesh to targets. Collective: all ranks call.
/// @param told  called with the steps of the work, see `Told`
/// All errors are thrown on all ranks:
/// @throws FormatError    as `SpreadTargets::read`; a target on a hole
/// @throws InvalidOption  fairness with targets at vertices, options that PETSc cannot read
/// @throws InvalidMesh    targets at vertices that cannot be met, unless `best_effort`
/// @throws AnalysisError  a fit that did not converge, unless `best_effort`; the message has the gradient
///                        reached
/// @throws InvalidParameter, ResourceError, ...  as `fairness_energy`, `place_rows`
SpreadFit fit(const Ranks& ranks, const SpreadJob& job, SpreadTargets& targets, const SpreadFitRequest& request,
              const std::function<void(const std::string&)>& told);

/// Writes control points as .npy, or as .ply with the faces of their mesh. Collective: all ranks call.
/// @param points  points of this rank's run, interleaved
/// @throws IoError, ResourceError, InvalidOption  on all ranks
void write_control_points(const Ranks& ranks, const SpreadMesh& mesh, std::span<const double> points,
                          const std::filesystem::path& path);

}  // namespace sublimit

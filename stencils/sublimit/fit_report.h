// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a fit did: as lines for people, and as JSON with everything (fit_format.md).
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/fit/interpolate.h"

namespace sublimit {

struct FitReport {
  std::string kind;                                          ///< "interpolation", "least-squares", ...
  std::string mesh, targets, scheme, output;                 ///< names, of files as given
  std::vector<std::pair<std::string, std::string>> options;  ///< of the scheme and of the fit, by name
  Index mesh_vertices = 0, mesh_faces = 0, output_vertices = 0, output_faces = 0;
  int refinements = 0;
  /// The first vertices of the output are the mesh's, in order; false under dual schemes.
  bool keeps_vertices = true;
  double box = 0;  ///< diagonal of the targets' bounding box

  std::vector<Index> vertices;  ///< targets at vertices, or
  std::vector<Sample> places;   ///< at places
  Points expected;              ///< where the limit should be, a target each
  Eigen::VectorXd position_error;
  Eigen::VectorXd normal_error;           ///< radians, NaN without a normal; empty: no target has one
  std::vector<double> weights;            ///< of targets at places; empty: all 1
  std::vector<Index> without_plane = {};  ///< targets whose normal was left out

  std::vector<InterpolationAttempt> attempts = {};  ///< of interpolations, the last one is the result
  std::optional<Conditioning> conditioning = {};    ///< of least squares
  std::optional<FitSolution> solution = {};         ///< absent where no system was solved
  std::vector<std::string> notes = {};
};

/// Largest and root mean square of the numbers that are there.
struct ErrorSummary {
  double largest = 0, rms = 0;
  Index count = 0;
};
ErrorSummary summary(const Eigen::VectorXd& errors);

/// A line each: what was met, why it was refined, errors, rank and condition, solver, which vertices are which.
std::string fit_summary(const FitReport& report);

/// The text of a report file. The same input gives the same bytes.
std::string fit_report(const FitReport& report);

}  // namespace sublimit

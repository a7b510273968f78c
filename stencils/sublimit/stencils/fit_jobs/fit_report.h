// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reports on fits: as lines of text, and as JSON with all data (fit_format.md).
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit/detail/interpolate.h"

namespace sublimit {

/// A level of a scheme without a matrix: what is not proved is measured.
struct FitLevel {
  Index vertices = 0, triangles = 0;
  double longest_edge = 0;
  double normal_deviation = 0;  ///< radians, the most between a triangle's normal and those of its corners' data
};

struct [[nodiscard]] FitReport {
  std::string kind;                            ///< interpolation, construction, least-squares, cloud, torus-pieces
  std::string mesh, targets, scheme, output;   ///< names, of files as given
  std::map<std::string, std::string> options;  ///< on the command line, of the scheme and of the fit
  Index mesh_vertices = 0, mesh_faces = 0, output_vertices = 0, output_faces = 0;
  int refinements = 0;
  bool keeps_vertices = true;  ///< the first vertices of the output are the mesh's, in order; not under dual schemes
  double box = 1;              ///< diagonal of the targets' bounding box, or of the mesh's, > 0

  std::vector<Index> vertices;  ///< targets at vertices, or
  std::vector<Place> places;    ///< at places
  std::vector<double> weights;  ///< weights of the targets; empty: all 1
  Points expected;              ///< position of each target
  Points normals;               ///< unit normal of each target, zero where none was given; no rows: no target has one
  Eigen::VectorXd position_error;
  Eigen::VectorXd normal_error;      ///< radians, NaN without a normal; empty: no target has one
  Eigen::VectorXd curvature_error;   ///< errors of k1 and k2, per unit of length; empty: no target has curvatures
  std::vector<Index> without_plane;  ///< vertices whose normal was left out
  std::vector<Index> carried_by;     ///< by target: the face of the output whose plane polygon carries it
  std::vector<Index> pinned;         ///< vertices

  std::vector<InterpolationAttempt> attempts;  ///< attempts of interpolations; the last one is the result
  std::optional<Conditioning> conditioning;    ///< conditioning of least squares
  std::optional<FitSolution> solution;         ///< absent where no system was solved
  std::vector<FitLevel> levels;                ///< levels of torus pieces, from 0
  std::vector<CloudIteration> iterations;      ///< iterations of fits to clouds, the given mesh first
  std::vector<std::string> notes;

  /// Targets at vertices are met.
  [[nodiscard]] bool solved() const { return attempts.empty() || attempts.back().solved; }
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

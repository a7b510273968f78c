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

/// Measured properties of a level of a nonlinear scheme, of which little is proved.
struct FitLevel {
  Index vertices = 0, triangles = 0;
  double longest_edge = 0;
  double normal_deviation = 0;  ///< largest angle of a triangle's normal and its corners' normals
};

struct [[nodiscard]] FitReport {
  std::string kind;                            ///< interpolation, construction, least-squares, cloud, torus-pieces
  std::string mesh, targets, scheme, output;   ///< names, of files as given
  std::map<std::string, std::string> options;  ///< options on the command line, of the scheme and of the fit
  Index mesh_vertices = 0, mesh_faces = 0, output_vertices = 0, output_faces = 0;
  int refinements = 0;
  bool keeps_vertices = true;  ///< the output starts with the mesh's vertices; false for dual schemes
  double box = 1;              ///< diagonal of the targets' bounding box, or of the mesh's, > 0

  std::vector<Index> vertices;  ///< targets at vertices; empty if they are at places
  std::vector<Place> places;    ///< places of the targets; empty if they are at vertices
  std::vector<double> weights;  ///< weights of the targets; empty: all 1
  Points expected;              ///< position of each target
  Points normals;               ///< unit normal of each target, zero where none was given; no rows: no target has one
  Eigen::VectorXd position_error;
  Eigen::VectorXd normal_error;      ///< radians, NaN without a normal; empty: no target has one
  Eigen::VectorXd curvature_error;   ///< errors of k1 and k2, per unit of length; empty: no target has curvatures
  std::vector<Index> without_plane;  ///< vertices whose normal was left out
  std::vector<Index> carried_by;     ///< for each target: face of the output whose plane polygon is at it
  std::vector<Index> pinned;         ///< vertices that were kept fixed

  std::vector<InterpolationAttempt> attempts;  ///< attempts of interpolations; the last one is the result
  std::optional<Conditioning> conditioning;    ///< conditioning of least squares
  std::optional<FitSolution> solution;         ///< absent where no system was solved
  std::vector<FitLevel> levels;                ///< levels of torus pieces, from 0
  std::vector<CloudIteration> iterations;      ///< iterations of fits to clouds, the given mesh first
  std::vector<std::string> notes;

  /// Returns true if targets at vertices are met.
  [[nodiscard]] bool solved() const { return attempts.empty() || attempts.back().solved; }
};

/// Largest value and root mean square of the numbers that are not NaN.
struct ErrorSummary {
  double largest = 0, rms = 0;
  Index count = 0;
};
ErrorSummary summary(const Eigen::VectorXd& errors);

/// Returns a report as lines of text: whether targets are met, reasons for refinement, errors, rank and
/// condition, the solver, the numbering of vertices.
std::string fit_summary(const FitReport& report);

/// Returns a report as JSON text. The same input gives the same bytes.
std::string fit_report(const FitReport& report);

}  // namespace sublimit

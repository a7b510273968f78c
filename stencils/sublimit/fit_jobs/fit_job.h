// SPDX-License-Identifier: Apache-2.0
#pragma once
// One fit from data to a control mesh and a report; the program reads and writes the files.
#include <functional>
#include <string>
#include <utility>

#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit_jobs/fit_report.h"
#include "sublimit/fit_jobs/fit_targets.h"

namespace sublimit {

struct FitSettings {
  std::string refine = "auto";  ///< or the number of refinements
  Fairness fairness = {};
  FitMethod method = FitMethod::automatic;
  bool best_effort = false;  ///< where targets cannot be met, what comes nearest
  bool rank = true;
  bool construct = false;  ///< plane polygons of dual schemes, without a system
  double size = .5;        ///< of these polygons
  Pins pins = {};          ///< of least squares
  int iterations = 50;     ///< of fits to clouds, at most
  int levels = 3;          ///< of schemes without a matrix
  SubdivisionOptions rules = {};
  std::function<void(const std::string&)> progress = {};  ///< what is being done, for people
};

struct ReportedFit {
  Level level;  ///< whose limit it is; of torus pieces absent
  Points points;
  FitReport report;  ///< without names of files
};

/// A report with what is known before the fit: counts, targets, box.
FitReport report_of(const std::string& kind, const std::string& scheme, const ControlMesh& mesh,
                    const FitTargets& targets);
FitReport report_of(const std::string& kind, const std::string& scheme, const Points& control_points, Index faces,
                    const FitTargets& targets);

/// Through points, and perhaps normals, at vertices: a linear system, or a construction.
/// @throws FormatError  what `check_vertices` refuses; curvatures, which are for torus pieces
/// @throws InvalidMesh  targets that cannot be met, unless `best_effort`: says which
/// @throws InvalidOption  a `refine` that is no number, `construct` for a scheme that cannot
ReportedFit fit_vertices(const Scheme<double>& scheme, const ControlMesh& mesh, const FitTargets& targets,
                         const FitSettings& settings);

/// Near points at places, least squares.
/// @throws FormatError  what `check_places` refuses
ReportedFit fit_scattered(const Scheme<double>& scheme, const ControlMesh& mesh, const FitTargets& targets,
                          const FitSettings& settings);

/// Free-form surfaces near points at places, least squares. Weights of rational ones stay; so do control points that no
/// target sees.
/// @param columns  of the control points
/// @return         columns, and a report without names of files
/// @throws FormatError       what `targets_on` refuses
/// @throws InvalidParameter  a control point of weight 0
std::pair<Points, FitReport> fit_patches(const PatchSet& patches, const Points& columns, const FitTargets& targets,
                                         const FitSettings& settings);

/// Near a cloud of points: projections and least squares in turn.
ReportedFit fit_near_cloud(const Scheme<double>& scheme, const ControlMesh& mesh, const Cloud& cloud,
                           const FitSettings& settings);

/// A cloud from a CSV with the header x,y,z or x,y,z,weight, or from a mesh: its vertices, each with its share of the
/// area, or so many points all over its faces.
/// @throws FormatError  what is none of them, a cloud without points, negative weights
Cloud read_cloud(const std::string& path, std::optional<Index> samples, unsigned seed);

/// Pins from a list of vertices, as in `3,7`, or from a CSV with the header vertex or vertex,x,y,z.
/// @throws InvalidOption, FormatError  what is neither, vertices that do not exist or are named twice
Pins read_pins(const std::string& text, Index num_vertices);

}  // namespace sublimit

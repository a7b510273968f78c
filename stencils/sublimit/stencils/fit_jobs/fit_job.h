// SPDX-License-Identifier: Apache-2.0
#pragma once
// One fit from data to a control mesh and a report; the program reads and writes the files.
#include <functional>
#include <string>
#include <utility>

#include "sublimit/fit/cloud_fit.h"
#include "sublimit/stencils/fit_jobs/fit_report.h"
#include "sublimit/stencils/fit_jobs/fit_targets.h"

namespace sublimit {

struct FitSettings {
  std::string refine = "auto";  ///< "auto", or a number of refinements before the fit
  Fairness fairness = {};
  FitMethod method = FitMethod::automatic;
  bool best_effort = false;  ///< return the nearest result if targets cannot be met
  bool rank = true;
  bool construct = false;  ///< plane polygons of dual schemes, without a system
  double size = .5;        ///< size of these polygons
  Pins pins = {};          ///< fixed control points, for least squares
  int iterations = 50;     ///< most iterations of fits to clouds
  int levels = 3;          ///< levels of schemes without a matrix
  SubdivisionOptions rules = {};
  std::function<void(const std::string&)> progress = {};  ///< called with a description of each step, if given
};

struct ReportedFit {
  Level level;  ///< level of the fitted mesh; empty for torus pieces
  Points points;
  FitReport report;  ///< report without names of files
};

/// Returns a report with the entries that are known before the fit: counts, targets, bounding box.
FitReport report_of(const std::string& kind, const std::string& scheme, const Mesh& mesh, const FitTargets& targets);
FitReport report_of(const std::string& kind, const std::string& scheme, const Points& control_points, Index faces,
                    const FitTargets& targets);

/// Fits a mesh to points, optionally with normals, at vertices: by a linear system, or a construction.
/// @throws FormatError  as `check_vertices`; curvatures, which are for torus pieces
/// @throws InvalidMesh  targets that cannot be met, unless `best_effort`; the message says which
/// @throws InvalidOption  a `refine` that is no number, `construct` for a scheme that cannot
ReportedFit fit_vertices(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                         const FitSettings& settings);

/// Fits a mesh to points at places, by least squares.
/// @throws FormatError  as `check_places`
ReportedFit fit_scattered(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                          const FitSettings& settings);

/// Fits free-form surfaces to points at places, by least squares. Weights of rational ones are kept, and so are control
/// points that no target depends on.
/// @param columns  columns of the control points
/// @return         fitted columns, and a report without names of files
/// @throws FormatError       as `targets_on`
/// @throws InvalidParameter  a control point of weight 0
std::pair<Points, FitReport> fit_patches(const PatchSet& patches, const Points& columns, const FitTargets& targets,
                                         const FitSettings& settings);

/// Fits a mesh to a cloud of points, by projections and least squares in turn.
ReportedFit fit_near_cloud(const Scheme<double>& scheme, const Mesh& mesh, const Cloud& cloud,
                           const FitSettings& settings);

/// Fits free-form surfaces to a cloud of points. Weights of rational ones are kept.
/// @return  fitted columns, and a report without names of files
/// @throws InvalidParameter  a control point of weight 0
std::pair<Points, FitReport> fit_patches_near_cloud(const PatchSet& patches, const Points& columns, const Cloud& cloud,
                                                    const FitSettings& settings);

/// Reads a cloud from a CSV with the header x,y,z or x,y,z,weight, or from a mesh: its vertices, weighted by their
/// share of the area, or a number of random points on its faces.
/// @throws FormatError  another file, a cloud without points, negative weights
Cloud read_cloud(const std::string& path, std::optional<Index> samples, unsigned seed);

/// Reads pins from a list of vertices such as `3,7`, or from a CSV with the header vertex or vertex,x,y,z.
/// @throws InvalidOption, FormatError  another text or file, vertices that do not exist or are named twice
Pins read_pins(const std::string& text, Index num_vertices);

}  // namespace sublimit

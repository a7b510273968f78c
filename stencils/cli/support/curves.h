// SPDX-License-Identifier: Apache-2.0
#pragma once
// The subcommands `refine` and `limit` for curve schemes.
#include "support/common.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit::cli {

/// Arguments of a subcommand for curves.
struct CurveJob {
  const Common* common;
  int levels = 0;
  std::string output, matrix;  ///< matrix may be empty
  bool closed = false;         ///< curves of a CSV are closed
  bool tangents = false;       ///< write tangents of the limit as columns
};

/// Returns true if `common.scheme` names a curve scheme.
bool is_curve_job(const Common& common);

/// Adds --closed to a subcommand that also takes curves.
void add_closed(CLI::App& command, bool& closed);
/// Checks a job that is not for curves.
/// @throws InvalidOption  no scheme of meshes has that name (it may be a misspelt one of curves), or `closed` is set
void check_mesh_job(const Common& common, bool closed);

/// Returns the options of the curve scheme.
/// @throws InvalidOption  options that are only for meshes
SchemeOptions curve_options(const Common& common);

/// Throws an error that suggests curve schemes if the input file is a polygon.
void refuse_polygon(const Common& common);

int refine_curves(const CurveJob& job);
int limit_curves(const CurveJob& job);

/// Refines curves by a nonlinear scheme, whose CSV also has tangents.
int refine_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);
int limit_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);

/// Checks the output of a curve job before work begins: OBJ files hold neither tangents nor more than three
/// coordinates.
void check_curve_output(const CurveJob& job);
ControlPolygon load_polygon(const CurveJob& job, Progress& progress, bool tangents = false);

}  // namespace sublimit::cli

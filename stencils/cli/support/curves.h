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
  bool tangents = false;       ///< write tangents of the limit as columns
};

/// Prints how many points of a limit were written, and how many of them have no tangent.
void tell_limit_points(const CurveJob& job, Index points, Index without);

/// Adds --closed to a subcommand that also takes curves.
void add_closed(CLI::App& command, Common& common);

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

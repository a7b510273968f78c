// SPDX-License-Identifier: Apache-2.0
#pragma once
// `refine` and `limit` for schemes of curves.
#include "support/common.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit::cli {

/// Arguments of a subcommand for curves.
struct CurveJob {
  const Common* common;
  int levels = 0;
  std::string output, matrix;  ///< matrix may be empty
  bool closed = false;         ///< a CSV has closed curves
  bool tangents = false;       ///< write tangents of the limit as columns
};

/// Returns true if `common.scheme` names a curve scheme.
bool is_curve_job(const Common& common);

/// Adds --closed to a subcommand that takes curves too.
void add_closed(CLI::App& command, bool& closed);
/// Checks a job that is not for curves.
/// @throws InvalidOption  no scheme of meshes has that name (it may be a misspelt one of curves), or `closed` is set
void check_mesh_job(const Common& common, bool closed);

/// Options of the scheme.
/// @throws InvalidOption  options of meshes
SchemeOptions curve_options(const Common& common);

/// Throws an error that suggests curve schemes if the input file is a polygon.
void refuse_polygon(const Common& common);

int refine_curves(const CurveJob& job);
int limit_curves(const CurveJob& job);

/// Refines by a scheme without a matrix, which has tangents in its CSV.
int refine_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);
int limit_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);

/// Checks the output of curves before work begins: OBJ holds no tangents and no more than three coordinates.
void check_curve_output(const CurveJob& job);
ControlPolygon load_polygon(const CurveJob& job, Progress& progress, bool tangents = false);

}  // namespace sublimit::cli

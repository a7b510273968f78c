// SPDX-License-Identifier: Apache-2.0
#pragma once
// What `refine` and `limit` do when the scheme is one for curves.
#include "common.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit::cli {

/// What a subcommand was asked for.
struct CurveJob {
  const Common* common;
  int levels = 0;
  std::string output, matrix;  ///< matrix may be empty
  bool closed = false;         ///< a CSV has closed curves
  bool tangents = false;       ///< of the limit, as columns
};

/// Whether `common.scheme` names a curve scheme.
bool is_curve_job(const Common& common);

/// Adds --closed to a subcommand that takes curves too.
void add_closed(CLI::App& command, bool& closed);
/// For a job that is none of curves.
/// @throws InvalidOption  no scheme of meshes has that name; it may be a misspelt one of curves. `closed` is for curves
void check_mesh_job(const Common& common, bool closed);

/// Options of the scheme.
/// @throws InvalidOption  options of meshes
SchemeOptions curve_options(const Common& common);

/// For a file that is no mesh: fails with a word about curve schemes if it is a polygon.
void refuse_polygon(const Common& common);

int refine_curves(const CurveJob& job);
int limit_curves(const CurveJob& job);

/// The same for schemes without a matrix, which have tangents in their CSV.
int refine_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);
int limit_geometric(const CurveJob& job, const GeometricCurveScheme& scheme);

/// What both kinds share. OBJ holds no tangents and no points of more than three coordinates; told early.
void check_curve_output(const CurveJob& job);
ControlPolygon load_polygon(const CurveJob& job, Progress& progress, bool tangents = false);

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of free-form curves and surfaces on the command line, which need no scheme.
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "support/source.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"

namespace sublimit::cli {

/// Prints the warnings of the shapes of a source.
void tell_warnings(const Source& source);
/// Makes patches of the surfaces of a file, and reports shapes that are left out.
FreeFormPatches free_form_patches_of(const Source& source);

/// Surfaces of a free-form .obj or of recipes, as one source. Surfaces that are left out are reported.
struct LoadedPatches {
  PatchSet patches;
  Points columns;  ///< control points x 3, or x 4 if homogeneous
};
LoadedPatches load_patches(const Source& source);
/// Curves of a free-form .obj or of recipes, as one source.
struct LoadedCurves {
  CurveSet curves;
  Points columns;
  Coordinates coordinates = Coordinates::plain;
};
LoadedCurves load_patch_curves(const Source& source);

/// Prints information on free-form shapes, for `info`.
/// @param integrals  over the surfaces, for JSON
void print_free_form(const Common& common, const FreeForm& shapes, bool json,
                     const std::optional<LimitIntegrals>& integrals);

/// Runs `refine` or `limit` for the free-form surfaces of a file.
void refine_free_form(const Source& source, int levels, const std::string& output, const std::string& matrix);
void limit_free_form(const Source& source, int levels, const std::string& output, bool normals);

/// A fit of the free-form surfaces of a file to targets at places.
struct FreeFormFit {
  FreeForm shapes;  ///< shapes with fitted control points
  FitReport report;
};
/// Computes columns of control points, and a report, from those that a file has.
using FitColumns = std::function<std::pair<Points, FitReport>(const PatchSet& patches, const Points& columns,
                                                              const FitSettings& settings)>;
/// Fits the free-form surfaces of a file.
/// @param pin  list of control points that stay fixed
/// @throws the errors of `fit`
/// @throws InvalidOption        recipes, whose data are not control points; `pin` is not a list
/// @throws UnsupportedTopology  surfaces whose control points are not those of the file: given by coefficients,
///                              or polynomial ones beside rational ones
FreeFormFit fit_free_form(const Source& source, const FitColumns& fit, FitSettings settings, const std::string& pin,
                          Progress& progress);

/// Returns the report of kind "free-form" on the curves and surfaces of a file, or of recipes.
/// `print_free_form_report` prints a summary of it.
/// @param tolerances  values of --tolerance
/// @throws InvalidOption  an invalid tolerance
nlohmann::ordered_json analyze_free_form(const Source& source, const std::vector<std::string>& tolerances,
                                         Progress& progress);
void print_free_form_report(const nlohmann::ordered_json& report);

}  // namespace sublimit::cli

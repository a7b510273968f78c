// SPDX-License-Identifier: Apache-2.0
// Control points of free-form surfaces that come near to given points.
#include "support/free_form.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"

namespace sublimit::cli {

FreeFormFit fit_free_form(const Source& source, const FitColumns& fit_columns, FitSettings settings,
                          const std::string& pin, Progress& progress) {
  const Common& common = source.common;
  if (source.recipes)
    throw InvalidOption("fits are of control points, and recipes have other data; `sublimit construct " + common.mesh +
                        " -o NET.obj` writes nets that can be fitted");
  tell_warnings(source);
  FreeFormFit fit{.shapes = *source.shapes, .report = {}};
  const FreeFormPatches found = free_form_patches(fit.shapes, common.mesh);
  const Index count = static_cast<Index>(fit.shapes.vertices.rows());
  if (found.patches.num_points() != count)
    throw UnsupportedTopology(common.mesh +
                              ": surfaces without weights beside rational ones have control points that the file does "
                              "not; put them in files of their own, or write `cstype rat` for all");
  if (!pin.empty()) settings.pins = read_pins(pin, count);
  progress.step("fitting");
  auto [columns, report] = fit_columns(found.patches, found.columns, settings);
  fit.shapes.vertices = columns.leftCols(3);
  if (columns.cols() == 4) fit.shapes.vertices.array().colwise() /= columns.col(3).array();
  fit.report = std::move(report);
  return fit;
}

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/step_file.h"

#include <cmath>
#include <vector>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/limit_model.h"
#include "sublimit/cad/patch_model.h"
#include "sublimit/io/detail/formats.h"

namespace sublimit {
namespace {

double diagonal_of(const Points& columns) {
  const Points points = points_in_space(columns);
  return points.rows() > 0 ? (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm() : 0;
}

/// Errors about the scheme name it.
LimitModel model_of(const LimitSurface& surface, const LimitModelOptions& options) {
  try {
    return limit_model(surface.map(), surface.points(), options);
  } catch (const UnsupportedTopology& error) {
    const auto& scheme = surface.map().level().made_by;
    if (!scheme) throw;
    throw UnsupportedTopology(scheme->name + ": " + error.what());
  }
}

StepFile write_model(BoundaryModel model, LengthUnit unit, const std::filesystem::path& path,
                     const CadFileMaker& make) {
  model.unit = unit;
  if (model.faces.empty()) throw InvalidMesh("no faces to write");
  const CadFile made = make(model, path.stem().string(), io_formats().writes(path, contents::step));
  AtomicFile file(path);
  file.write(made.bytes);
  file.commit();
  return {.solids = made.solids,
          .shells = made.shells,
          .faces = std::int64_t(model.faces.size()),
          .is_valid = made.is_valid};
}

}  // namespace

void check_step(const std::filesystem::path& path, const StepOptions& options) {
  if (!io_formats().writes(path, contents::cad))
    throw InvalidOption(path.string() + ": CAD files are " + io_formats().writers_in_words({contents::cad}, "or") +
                        ", not '" + file_extension(path) + "'");
  if (options.unit != LengthUnit::mm && !io_formats().writes(path, contents::step))
    throw InvalidOption(path.string() + ": only STEP files have a unit of length; write one, or leave the unit out");
  if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance)))
    throw InvalidParameter("tolerance is " + format_number(*options.tolerance) +
                           "; it should be a length, more than 0");
}

StepFile write_step(const LimitSurface& surface, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make) {
  check_step(path, options);
  LimitModelOptions wanted;
  wanted.tolerance = options.tolerance.value_or(1e-5 * diagonal_of(surface.points()));
  if (!(wanted.tolerance > 0))
    throw InvalidMesh("the control points have no extent that a tolerance could be a part of");
  wanted.join_smoothly = options.join == StepJoin::g1;
  wanted.pack = options.pack;
  wanted.face_names = options.face_names;
  wanted.face_values = options.face_values;
  const LimitModel model = model_of(surface, wanted);
  StepFile file = write_model(model.boundary, options.unit, path, make);
  file.caps = model.caps;
  file.deviation = model.deviation;
  file.met = model.met;
  return file;
}

StepFile write_step(const Patches& patches, const std::filesystem::path& path, const StepOptions& options,
                    const CadFileMaker& make) {
  check_step(path, options);
  std::vector<NamedPatch> named;
  for (Index i = 0; i < patches.num_patches(); ++i)
    named.push_back({.patch = patches.set().members()[size_t(i)].patch,
                     .columns = patches.set().columns_of(size_t(i), patches.points()),
                     .coordinates = patches.set().coordinates(),
                     .place = "patch " + std::to_string(i)});
  PatchModelOptions wanted;
  const double diagonal = diagonal_of(patches.points());
  if (options.tolerance && diagonal > 0) wanted.same = *options.tolerance / diagonal;
  return write_model(patch_model(named, wanted).boundary, options.unit, path, make);
}

}  // namespace sublimit

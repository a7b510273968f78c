// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/implicit.h"

#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/implicit/detail/level_set_mesh.h"
#include "sublimit/stencils/recipes/detail/field_recipe.h"

namespace sublimit {

ImplicitMesh implicit_mesh(const std::string& field, const AnyScheme& scheme,
                           const std::function<Mesh(const FieldGrid&)>& polygonize, const ImplicitOptions& options) {
  if (options.cells != 0 && options.cells < 4)
    throw InvalidParameter("cells is " + std::to_string(options.cells) + "; it should be 4 or more, or 0");
  if (!(options.tolerance >= 0 && std::isfinite(options.tolerance)))
    throw InvalidParameter("tolerance is " + format_number(options.tolerance) + "; it should be a length, or 0");
  const size_t first = field.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string::npos && field[first] == '{';
  const FieldJob job = is_json ? parse_field_job(field, "field") : read_field_job(field);
  LevelSetOptions wanted{.box = job.box, .cells = options.cells != 0 ? options.cells : job.cells};
  wanted.tolerance = options.tolerance;
  wanted.progress = options.progress;
  LevelSetMesh found = level_set_mesh(job.field, *scheme, polygonize, wanted);
  return {.mesh = std::move(found.cage),
          .met = found.met(),
          .tolerance = found.tolerance,
          .largest_distance = found.attempt.error.largest,
          .mean_distance = found.attempt.error.mean,
          .notes = std::move(found.notes)};
}

}  // namespace sublimit

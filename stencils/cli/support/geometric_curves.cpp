// SPDX-License-Identifier: Apache-2.0
// Curves by schemes without a matrix.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/curves.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

/// The checked polygon; says where the scheme falls back on another rule.
ControlPolygon checked_polygon(const CurveJob& job, const GeometricCurveScheme& scheme, Progress& progress) {
  if (job.levels < 0) throw InvalidParameter(fmt::format("levels is {}; it must be 0 or more", job.levels));
  ControlPolygon polygon = scheme.checked(load_polygon(job, progress, true));
  const double first = polygon.num_points(), points = std::ldexp(first, job.levels);
  const double bytes = 6 * 8.0 * polygon.dimension() + 16;  // of a point
  constexpr double most_points = std::numeric_limits<Index>::max();
  const std::string amount = fmt::format("{} levels of {} points", job.levels, first);
  const std::string advice =
      fmt::format("use at most {}", most_levels(first, 2, std::min(most_points, memory_limit() / bytes)));
  if (points > most_points)
    throw ResourceError(fmt::format("{} are more points than 32-bit indices count; {}", amount, advice));
  check_memory(amount, points * bytes, advice);
  if (!job.common->quiet)
    for (const std::string& note : scheme.notes(polygon))
      fmt::print(stderr, "sublimit: note: {}: {}\n", job.common->mesh, note);
  return polygon;
}

}  // namespace

int refine_geometric(const CurveJob& job, const GeometricCurveScheme& scheme) {
  check_curve_output(job);
  if (!job.matrix.empty())
    throw InvalidOption(
        fmt::format("cannot write {}: {}: it is not linear: there is no matrix", job.matrix, scheme.name));
  Progress progress(job.common->quiet);
  ControlPolygon result =
      refine(scheme, checked_polygon(job, scheme, progress), job.levels, telling_levels(progress, job.levels));
  progress.step("writing " + job.output);
  write_polygon(job.output, result);
  progress.step("");
  if (!job.common->quiet && !all_formats().writes(job.output, contents::tangents))
    fmt::print(stderr, "sublimit: note: {} has points alone; a {} keeps the tangents, so that refining can go on\n",
               job.output, listed(all_formats().writers({contents::tangents}), "or"));
  return 0;
}

int limit_geometric(const CurveJob& job, const GeometricCurveScheme& scheme) {
  check_curve_output(job);
  Progress progress(job.common->quiet);
  const ControlPolygon polygon = checked_polygon(job, scheme, progress);
  progress.step("limits");
  ControlPolygon result = scheme.limit(polygon, job.levels);
  if (!job.tangents) {
    result.tangents.resize(0, 0);
    if (!result.columns.empty()) result.columns.resize(result.dimension());
  }
  progress.step("writing " + job.output);
  write_polygon(job.output, result);
  progress.step("");
  tell_limit_points(job, result.num_points(), 0);
  return 0;
}

}  // namespace sublimit::cli

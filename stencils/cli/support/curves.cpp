// SPDX-License-Identifier: Apache-2.0
#include "support/curves.h"
#include "support/facts.h"

#include <fmt/core.h>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/matrix_market.h"

namespace sublimit::cli {
namespace {

std::string curve_scheme_names() {
  std::string names;
  for (const CurveScheme<double>& scheme : all_curve_schemes()) names += (names.empty() ? "" : ", ") + scheme.name;
  for (const auto& entry : geometric_registry<ControlPolygon>) names += ", " + std::string(entry.name);
  return names;
}

CurveScheme<double> scheme_of(const Common& common) { return curve_scheme(common.scheme, given_options(common)); }

}  // namespace

void add_closed(CLI::App& command, Common& common) {
  command.add_flag("--closed", common.closed,
                   "Curves: a CSV has closed ones (an OBJ line that comes back is closed anyway)");
}

ControlPolygon load_polygon(const CurveJob& job, Progress& progress, bool tangents) {
  const Common& common = *job.common;
  limit_threads(common);
  if (all_formats().reads(common.mesh, contents::meshes) && !all_formats().reads(common.mesh, contents::polygons))
    throw UnsupportedTopology(common.mesh + ": a mesh; " + common.scheme +
                              " refines curves, a .csv of points or the lines of an .obj");
  progress.step("reading " + common.mesh);
  ControlPolygon polygon = read_polygon(common.mesh, tangents);
  for (size_t c = 0; common.closed && c < polygon.curves.size(); ++c) {
    ControlPolygon::Curve& curve = polygon.curves[c];
    curve.closed = true;
    const auto point = [&](Index i) { return polygon.points.row(i); };
    if (curve.points.size() > 3 && point(curve.points.front()) == point(curve.points.back())) {
      curve.points.pop_back();
      polygon.warnings.push_back(fmt::format(
          "{}: curve {} ends in its first point; --closed joins them, and the last one is left out", common.mesh, c));
    }
  }
  progress.step("");
  if (common.strict && !polygon.warnings.empty()) throw InvalidMesh(polygon.warnings.front());
  if (!common.quiet)
    for (const std::string& warning : polygon.warnings) fmt::print(stderr, "sublimit: warning: {}\n", warning);
  return polygon;
}

void check_curve_output(const CurveJob& job) {
  check_output_path(job.output, all_formats().writers({contents::tangents, contents::polygons}));
  if (!job.matrix.empty()) check_output_path(job.matrix, all_formats().writers({contents::matrices}));
  if (job.tangents && !all_formats().writes(job.output, contents::tangents))
    throw InvalidOption("cannot write " + job.output + ": tangents are columns of a " +
                        listed(all_formats().writers({contents::tangents}), "or"));
}

namespace {

struct Refined {
  ControlPolygon polygon;
  std::vector<CurveLevel> levels;
  Points unknowns;  ///< of the last level
};

Refined refined(const CurveJob& job, const CurveScheme<double>& scheme, Progress& progress) {
  Refined result{load_polygon(job, progress, scheme.masks.unknowns() > 1), {}, {}};
  if (!all_formats().writes(job.output, contents::tangents) && result.polygon.dimension() > 3)
    throw InvalidOption(fmt::format("cannot write {}: an {} has points of 3 coordinates, these have {}; write a {}",
                                    job.output, file_extension(job.output), result.polygon.dimension(),
                                    listed(all_formats().writers({contents::tangents}), "or")));
  naming_mesh(*job.common, [&] {
    result.levels = refine(scheme, result.polygon, job.levels, telling_levels(progress, job.levels));
    result.unknowns = unknowns(scheme, result.polygon);
  });
  for (const CurveLevel& level : result.levels) result.unknowns = apply(level.S, result.unknowns);
  return result;
}

/// Makes first derivatives at the points of a level unit tangents; not-a-number where there is none, as at corners.
/// @return  number of points without a tangent
Index unit_tangents(const CurveLevel& level, const std::vector<CurvePlace>& places, CurveSamples& found) {
  Index without = 0;
  size_t i = 0;
  for (const CurveOutline& curve : level.curves) {
    const CurvePlace start = places[i], end = places[i + size_t(curve.size) - 1];
    for (Index a = 0; a < curve.size; ++a, ++i) {
      const bool is_end = !curve.closed && (places[i] == start || places[i] == end);
      const bool is_corner = found.status[i] == LimitStatus::crease && !is_end;
      const bool defined = found.order[i] > 0 && found.status[i] != LimitStatus::undefined_normal && !is_corner;
      without += !defined;
      auto tangent = found.first.row(Eigen::Index(i));
      if (defined)
        tangent /= tangent.stableNorm();
      else
        tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return without;
}

}  // namespace

void tell_limit_points(const CurveJob& job, Index points, Index without) {
  Facts facts("limit");
  facts.say("{output}: {points} limit points of level {level}",
            {{"output", job.output}, {"points", points}, {"level", job.levels}});
  if (job.tangents) facts.say(", {without_tangent} without a tangent", {{"without_tangent", without}});
  facts.say("\n");
  facts.print(*job.common);
}

void refuse_polygon(const Common& common) {
  bool polygon = all_formats().reads(common.mesh, contents::polygons);
  if (polygon && all_formats().reads(common.mesh, contents::meshes)) {
    const std::string text = read_inflated(common.mesh);
    const auto has = [&](const char* start) {
      return text.starts_with(start + 1) || text.find(start) != std::string::npos;
    };
    polygon = has("\nl ") && !has("\nf ");
  }
  if (polygon)
    throw UnsupportedTopology(common.mesh + ": a polygon, no mesh; " +
                              (common.scheme.empty() ? "" : common.scheme + " refines meshes, ") +
                              "curve schemes are " + curve_scheme_names());
}

int refine_curves(const CurveJob& job) {
  if (const auto scheme = find_geometric_scheme(job.common->scheme, given_options(*job.common)))
    return refine_geometric(job, *scheme);
  check_curve_output(job);
  Progress progress(job.common->quiet);
  const CurveScheme<double> scheme = scheme_of(*job.common);
  const Refined curves = refined(job, scheme, progress);
  if (!job.matrix.empty()) {
    progress.step("multiplying");
    write_matrix_market(job.matrix, refinement_matrix(curves.levels));
  }
  progress.step("writing " + job.output);
  ControlPolygon result = refined_polygon(curves.levels.back(), curves.unknowns);
  result.columns = curves.polygon.columns;
  write_polygon(job.output, result);
  return 0;
}

int limit_curves(const CurveJob& job) {
  if (const auto scheme = find_geometric_scheme(job.common->scheme, given_options(*job.common)))
    return limit_geometric(job, *scheme);
  check_curve_output(job);
  Progress progress(job.common->quiet);
  const CurveScheme<double> scheme = scheme_of(*job.common);
  const Refined curves = refined(job, scheme, progress);
  const CurveLevel& level = curves.levels.back();
  ControlPolygon result = curve_outlines(level);
  Index without = 0;
  naming_mesh(*job.common, [&] {
    progress.step("limits");
    const LimitCurve limit(scheme, level);
    const std::vector<CurvePlace> places = limit.point_places();
    CurveSamples found = limit.evaluate(curves.unknowns, places, job.tangents ? 1 : 0);
    result.points = std::move(found.position);
    if (job.tangents) without = unit_tangents(level, places, found);
    result.tangents = std::move(found.first);
  });
  if (!job.tangents) result.columns = curves.polygon.columns;
  progress.step("writing " + job.output);
  write_polygon(job.output, result);
  progress.step("");
  tell_limit_points(job, result.num_points(), without);
  return 0;
}

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sublimit/stencils/fit_jobs/fit_report.h"

namespace sublimit {
namespace {

std::string counted(Index count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Why an attempt before the last one did not do.
std::string reason(const InterpolationAttempt& attempt) {
  if (!attempt.undetermined.empty())
    return fmt::format("the limits of {} depend on each other: rank {} of {}", listed_vertices(attempt.undetermined),
                       attempt.conditioning.rank, attempt.unknowns);
  if (attempt.conditions > attempt.unknowns)
    return fmt::format("{} conditions on {} coordinates", attempt.conditions, attempt.unknowns);
  return "the targets of " + listed_vertices(attempt.contradictory) + " cannot be met";
}

std::string refined(const FitReport& r) {
  if (r.attempts.empty() || r.refinements == 0) return "";
  std::string text = "  " + counted(r.refinements, "refinement", "refinements");
  if (r.attempts.size() == 1) {
    // Nothing was tried before: too few coordinates, or asked for.
    const Index conditions =
        3 * static_cast<Index>(r.vertices.size()) + 2 * static_cast<Index>(summary(r.normal_error).count);
    return text + (conditions > 3 * r.mesh_vertices
                       ? fmt::format(": {} conditions are too many for {} coordinates without\n", conditions,
                                     3 * r.mesh_vertices)
                       : "\n");
  }
  for (size_t k = 0; k + 1 < r.attempts.size(); ++k)
    text += (k ? "; with " + std::to_string(r.attempts[k].refinements) + ", " : ": without, ") + reason(r.attempts[k]);
  return text + "\n";
}

std::string system(const Conditioning& c, const char* unknowns) {
  if (c.rows == 0 && c.columns == 0) return "";
  return fmt::format("  {} on {} {}: rank {}, condition {:.3g}, smallest singular value {:.3g}\n",
                     counted(c.rows, "condition", "conditions"), c.columns, unknowns, c.rank, c.condition(),
                     c.smallest);
}

}  // namespace

ErrorSummary summary(const Eigen::VectorXd& errors) {
  ErrorSummary found;
  double squares = 0;
  for (const double error : errors) {
    if (std::isnan(error)) continue;
    found.largest = std::max(found.largest, error);
    squares += error * error;
    ++found.count;
  }
  if (found.count > 0) found.rms = std::sqrt(squares / found.count);
  return found;
}

std::string fit_summary(const FitReport& r) {
  const ErrorSummary position = summary(r.position_error), normal = summary(r.normal_error);
  std::string text = fmt::format("{}: {}, {}", r.output,
                                 counted(r.output_vertices, r.levels.empty() ? "control point" : "point",
                                         r.levels.empty() ? "control points" : "points"),
                                 counted(r.output_faces, "face", "faces"));
  text += fmt::format("; {} {}",
                      !r.levels.empty()                                               ? "they keep"
                      : r.kind == "least-squares" || r.kind == "cloud" || !r.solved() ? "the limit is near"
                                                                                      : "the limit meets",
                      counted(position.count, "point", "points"));
  if (normal.count > 0)
    text += (r.curvature_error.size() > 0 ? ", " : " and ") + counted(normal.count, "normal", "normals");
  if (r.curvature_error.size() > 0) text += " and their curvatures";
  text += "\n" + refined(r);
  text += fmt::format("  position error {:.2g} of the box at most, {:.2g} rms", position.largest / r.box,
                      position.rms / r.box);
  if (normal.count > 0) text += fmt::format("; normal error {:.2g} rad at most", normal.largest);
  if (r.curvature_error.size() > 0) text += fmt::format("; curvature error {:.2g}", summary(r.curvature_error).largest);
  text += "\n";
  for (size_t k = 0; k < r.levels.size(); ++k)
    text += fmt::format(
        "  level {}: {} triangles, edges up to {:.3g} of the box, normals off theirs by {:.3g} degrees at most\n", k,
        r.levels[k].triangles, r.levels[k].longest_edge / r.box, r.levels[k].normal_deviation * 180 / M_PI);
  if (!r.iterations.empty())
    text += fmt::format("  {}: from {:.2g} of the box rms to {:.2g}\n",
                        counted(static_cast<Index>(r.iterations.size()) - 1, "iteration", "iterations"),
                        r.iterations.front().rms / r.box, r.iterations.back().rms / r.box);
  if (!r.attempts.empty()) {
    const Conditioning& c = r.attempts.back().conditioning;
    text += system(c, c.columns == r.output_vertices ? "control points" : "coordinates");
  }
  if (r.conditioning) text += system(*r.conditioning, "control points");
  if (r.solution)
    text += fmt::format(
        "  solved {}, {}{}\n", r.solution->method == FitMethod::iterative ? "by conjugate gradients" : "directly",
        counted(r.solution->iterations, "iteration", "iterations"), r.solution->converged ? "" : ", not converged");
  if (r.refinements > 0 && r.keeps_vertices && r.mesh_vertices > 0)
    text += fmt::format("  vertices 0 to {} of {} are those of {}, in order\n", r.mesh_vertices - 1, r.output, r.mesh);
  if (!r.keeps_vertices)
    text += fmt::format("  {} does not keep vertices: those of {} are not those of {}\n", r.scheme, r.output, r.mesh);
  for (const std::string& note : r.notes) text += "  " + note + "\n";
  return text;
}

}  // namespace sublimit

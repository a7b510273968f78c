// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/fit_jobs/fit_job.h"

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/fit/detail/point_normal_polygons.h"
#include "sublimit/patches/detail/weighted_source.h"

namespace sublimit {
namespace {

double diagonal(const Points& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

FitSolverOptions solver_of(const FitSettings& settings) {
  return {.method = settings.method, .progress = [&settings](int iteration, double residual) {
            if (settings.progress)
              settings.progress("solving: iteration " + format_number(iteration) + ", residual " +
                                format_number(static_cast<float>(residual)));
          }};
}

void tell(const FitSettings& settings, const char* what) {
  if (settings.progress) settings.progress(what);
}

void count(ReportedFit& fit, const Scheme<double>& scheme) {
  fit.report.output_vertices = fit.level.topology().num_vertices();
  fit.report.output_faces = fit.level.topology().num_faces();
  fit.report.refinements = fit.level.number;
  fit.report.keeps_vertices = fit.level.number == 0 || !scheme.is_dual();
}

ReportedFit construct(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                      const FitSettings& settings) {
  if (!scheme.is_dual())
    throw InvalidOption(
        "--construct is for schemes that make faces of vertices (doo-sabin, mid-edge and their "
        "like), and " +
        scheme.name + " does not; leave it out");
  tell(settings, "laying polygons");
  PointNormalMesh made =
      point_normal_mesh(scheme, mesh, targets.vertices, {.size = settings.size, .rules = settings.rules});
  ReportedFit fit{.level = std::move(made.level),
                  .points = std::move(made.points),
                  .report = report_of("construction", scheme.name, mesh, targets)};
  fit.report.position_error = std::move(made.position_residual);
  if (targets.num_normals > 0) fit.report.normal_error = std::move(made.normal_residual);
  fit.report.carried_by = std::move(made.faces);
  if (!made.folded.empty())
    fit.report.notes.push_back(format_number(made.folded.size()) +
                               " normals oppose the winding of the mesh, the first at vertex " +
                               format_number(made.folded.front()) + ": the surface folds there");
  return fit;
}

ReportedFit interpolated(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                         const FitSettings& settings) {
  InterpolationOptions options{.fairness = settings.fairness,
                               .solver = solver_of(settings),
                               .rules = settings.rules,
                               .conditioning = settings.rank};
  if (settings.refine != "auto") {
    const Parsed<int> number = parse_number<int>(settings.refine);
    if (!number || number.value < 0)
      throw InvalidOption("--refine " + settings.refine + ": it should be auto, or a whole number, 0 or more");
    options.least_refinements = options.most_refinements = number.value;
  }
  tell(settings, settings.rank ? "solving, rank and condition included (--no-rank leaves them out)" : "solving");
  Interpolation found = interpolate(scheme, mesh, targets.vertices, options);
  const InterpolationAttempt& last = found.attempts.back();
  if (!found.solved() && !settings.best_effort)
    throw InvalidMesh(why_unsolved(last) + "; --best-effort writes what comes nearest");
  ReportedFit fit{.level = std::move(found.level),
                  .points = std::move(found.points),
                  .report = report_of("interpolation", scheme.name, mesh, targets)};
  FitReport& report = fit.report;
  report.position_error = std::move(found.position_error);
  if (targets.num_normals > 0) report.normal_error = std::move(found.normal_error);
  report.solution = std::move(found.solution);
  for (const Index i : found.without_plane) report.without_plane.push_back(targets.vertices[size_t(i)].vertex);
  if (!report.without_plane.empty())
    report.notes.push_back("the scheme has no tangent plane at " + format_number(report.without_plane.size()) +
                           " of the vertices, the first is " + format_number(report.without_plane.front()) +
                           ": their normals are left out");
  if (!found.solved())
    report.notes.push_back("not met: " + why_unsolved(last));
  else if (!last.undetermined.empty())
    report.notes.push_back(
        "these targets agree though the limits depend on each other; of all such control points "
        "those nearest to the mesh are taken");
  report.attempts = std::move(found.attempts);
  return fit;
}

/// Points of any source near targets at places.
std::pair<Points, FitReport> least_squares(const LinearSource& surface, const std::string& scheme, const Points& guess,
                                           const FitTargets& targets, const FitSettings& settings) {
  ScatteredFit found = fit_places(surface, targets.places, guess,
                                  {.fairness = settings.fairness,
                                   .pins = settings.pins,
                                   .solver = solver_of(settings),
                                   .conditioning = settings.rank});
  FitReport report = report_of("least-squares", scheme, guess, surface.faces().size, targets);
  report.position_error = std::move(found.residuals);
  report.conditioning = std::move(found.conditioning);
  report.solution = std::move(found.solution);
  report.pinned = settings.pins.vertices;
  if (report.conditioning && report.conditioning->rank < report.conditioning->columns && settings.fairness.empty())
    report.notes.push_back(
        "the targets do not determine all control points; of all best fits the nearest to what "
        "was given is taken (--thin-plate or --membrane would take the fairest)");
  return {std::move(found.points), std::move(report)};
}

CloudFitOptions cloud_options(const FitSettings& settings) {
  CloudFitOptions options{.fairness = settings.fairness,
                          .pins = settings.pins,
                          .iterations = settings.iterations,
                          .solver = {.method = settings.method}};
  options.progress = [&](int iteration, const CloudIteration& at) {
    if (settings.progress)
      settings.progress("iteration " + format_number(iteration) + ": distances " +
                        format_number(static_cast<float>(at.rms)) + " rms");
  };
  return options;
}

/// The cloud at its places on the result.
FitTargets targets_at(const CloudFit& found, const Cloud& cloud) {
  FitTargets targets;
  targets.by_place = true;
  targets.places = {found.foot_points.places, cloud.points, cloud.weights};
  return targets;
}

void add_iterations(FitReport& report, CloudFit& found, const FitSettings& settings) {
  report.position_error = std::move(found.foot_points.distances);
  report.iterations = std::move(found.iterations);
  report.pinned = settings.pins.vertices;
  if (!found.converged)
    report.notes.push_back("not converged: distances still fall; --iterations allows more than " +
                           format_number(settings.iterations));
}

}  // namespace

FitReport report_of(const std::string& kind, const std::string& scheme, const Mesh& mesh, const FitTargets& targets) {
  return report_of(kind, scheme, mesh.positions, mesh.num_faces(), targets);
}

FitReport report_of(const std::string& kind, const std::string& scheme, const Points& control_points, Index faces,
                    const FitTargets& targets) {
  FitReport report;
  report.kind = kind;
  report.scheme = scheme;
  report.mesh_vertices = static_cast<Index>(control_points.rows());
  report.mesh_faces = faces;
  report.expected = targets.positions();
  report.box = diagonal(report.expected);
  if (!(report.box > 0)) report.box = diagonal(control_points);
  if (!(report.box > 0)) report.box = 1;
  for (const VertexTarget& target : targets.vertices) report.vertices.push_back(target.vertex);
  if (targets.num_normals > 0) report.normals = Points::Zero(report.expected.rows(), 3);
  for (size_t i = 0; i < targets.vertices.size(); ++i)
    if (const auto& n = targets.vertices[i].normal)
      report.normals.row(static_cast<Index>(i)) = (*n / n->cwiseAbs().maxCoeff()).normalized();
  report.places = targets.places.places;
  report.weights = targets.places.weights;
  return report;
}

ReportedFit fit_vertices(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                         const FitSettings& settings) {
  if (targets.num_curvatures > 0)
    throw FormatError(targets.file.string() + ": " + scheme.name +
                      " is linear and takes points and normals; leave the columns k1,k2,d1x,d1y,d1z out, or fit with "
                      "-s torus-pieces");
  const Level control = control_level(scheme, mesh, settings.rules);
  check_vertices(targets, control.topology(), control.holes);
  ReportedFit fit =
      settings.construct ? construct(scheme, mesh, targets, settings) : interpolated(scheme, mesh, targets, settings);
  count(fit, scheme);
  return fit;
}

ReportedFit fit_scattered(const Scheme<double>& scheme, const Mesh& mesh, const FitTargets& targets,
                          const FitSettings& settings) {
  tell(settings, "taking stencils");
  const LimitMap surface(scheme, mesh, settings.rules);
  check_places(targets, surface.addresses(), surface.level().holes);
  auto [points, report] = least_squares(surface, scheme.name, mesh.positions, targets, settings);
  ReportedFit fit{.level = surface.level(), .points = std::move(points), .report = std::move(report)};
  fit.report.mesh_faces = mesh.num_faces();
  count(fit, scheme);
  return fit;
}

std::pair<Points, FitReport> fit_patches(const PatchSet& patches, const Points& columns, const FitTargets& targets,
                                         const FitSettings& settings) {
  tell(settings, "taking stencils");
  FitSettings own = settings;
  own.fairness.quadrature = 8;  // of degrees above 3 too
  const FitTargets placed = targets_on(patches, targets);
  const auto fit = [&](const LinearSource& source, const Points& points) {
    auto result = least_squares(source, "free-form", points, placed, own);
    result.second.output_vertices = source.num_points();
    result.second.output_faces = source.faces().size;
    return result;
  };
  if (patches.coordinates() == Coordinates::plain) return fit(patches, columns);
  const Eigen::VectorXd weights = columns.col(3);
  auto result = fit(WeightedSource(patches, weights), columns.leftCols(3).array().colwise() / weights.array());
  result.first = homogeneous(result.first, weights);
  return result;
}

ReportedFit fit_near_cloud(const Scheme<double>& scheme, const Mesh& mesh, const Cloud& cloud,
                           const FitSettings& settings) {
  const LimitMap surface(scheme, mesh, settings.rules);
  tell(settings, "projecting");
  CloudFit found = fit_cloud(surface, cloud, mesh.positions, cloud_options(settings));
  ReportedFit fit{.level = surface.level(),
                  .points = std::move(found.points),
                  .report = report_of("cloud", scheme.name, mesh, targets_at(found, cloud))};
  add_iterations(fit.report, found, settings);
  count(fit, scheme);
  return fit;
}

std::pair<Points, FitReport> fit_patches_near_cloud(const PatchSet& patches, const Points& columns, const Cloud& cloud,
                                                    const FitSettings& settings) {
  tell(settings, "projecting");
  CloudFit found = fit_cloud(Patches(patches, columns), cloud, cloud_options(settings));
  FitReport report =
      report_of("cloud", "free-form", points_in_space(found.points), patches.faces().size, targets_at(found, cloud));
  add_iterations(report, found, settings);
  report.output_vertices = patches.num_points();
  report.output_faces = patches.faces().size;
  return {std::move(found.points), std::move(report)};
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/asset_report.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/report/asset/curvature_statistics.h"
#include "sublimit/report/asset/display_surface.h"
#include "sublimit/report/asset/seams.h"
#include "sublimit/report/asset/undefined_normals.h"
#include "sublimit/report/asset/warnings.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {
namespace {

void check(const AssetOptions& o) {
  for (const std::optional<double>& t : {o.tolerance.g0, o.tolerance.g1_degrees, o.tolerance.g2})
    if (t && !(*t >= 0)) throw InvalidOption("a tolerance is negative; it should be 0 or more");
  if (o.curvature_samples < 1 || o.surface_faces < 1 || o.levels < 1 || o.listed < 1)
    throw InvalidOption("samples, faces, levels and listed places should be 1 or more");
}

/// Of edges of one seam and of statistics, the places that people look at.
std::vector<AssetPlace> worst_places(const AssetReport& report) {
  std::vector<AssetPlace> places = report.curvature.worst;
  for (const SeamExcess& e : report.seams.worst) {
    if (e.at == SeamExcess::At::point) continue;
    const char* where = e.at == SeamExcess::At::patch ? " inside a face" : " across an edge";
    places.push_back({e.what + std::string(where), e.value, e.address, e.u, e.v, e.place});
  }
  return places;
}

}  // namespace

AssetReport asset_report(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& subdivision,
                         const AssetOptions& options, const std::function<void(int, int)>& progress) {
  check(options);
  constexpr int parts = 1000;
  const auto part = [&](double from, double to) {
    return [&progress, from, to](double done) {
      if (progress) progress(int(parts * (from + done * (to - from))), parts);
    };
  };
  const auto types = std::make_shared<LimitCache>(scheme);
  const LimitMap surface(scheme, mesh, subdivision, types);
  check_in_space(mesh.positions);
  check_measurable_control(mesh.positions);
  const Topology& t = surface.level().topology();

  AssetReport report;
  report.scheme = scheme.name;
  report.vertices = t.num_vertices();
  report.faces = t.num_faces();
  report.edges = t.num_edges();
  report.tolerance = options.tolerance;
  if (mesh.positions.rows() > 0) {
    report.box_min = mesh.positions.colwise().minCoeff().transpose();
    report.box_max = mesh.positions.colwise().maxCoeff().transpose();
  }
  const double diagonal = (report.box_max - report.box_min).norm();
  asset::PointVerdicts verdicts(scheme);
  asset::Inventory inventory = asset::inventory(scheme, surface.level(), verdicts, options.listed);
  part(0, .1)(1);
  const LimitSurface bound(surface, mesh.positions);
  part(0, .2)(1);
  const asset::LimitTraits traits{.polynomial = !types->pieces().has_no_polynomials(),
                                  .dual = scheme.is_dual(),
                                  .thirds = scheme.steps[0].split == Split::sqrt3};
  const asset::SeamPlaces places(scheme, surface, inventory, traits.polynomial);
  report.seams = asset::measure_seams(places, t, bound, diagonal, options.tolerance, options.listed, part(.2, .7));
  report.curvature = asset::curvature_statistics(surface, bound, options.curvature_samples, traits, part(.7, .9));
  report.curvature.unbounded_at = inventory.unbounded;
  report.surface = asset::display_surface(surface, bound, traits, options.surface_faces);
  report.warnings = asset::warnings(scheme, surface.level(), mesh.positions, inventory, verdicts, options);
  for (AssetWarning& warning : asset::undefined_normals(surface, bound, inventory, mesh.positions, options.listed))
    report.warnings.push_back(std::move(warning));
  std::stable_sort(report.warnings.begin(), report.warnings.end(),
                   [](const AssetWarning& a, const AssetWarning& b) { return a.severity < b.severity; });
  report.inventory = std::move(inventory.kinds);
  report.worst = worst_places(report);
  part(0, 1)(1);
  return report;
}

}  // namespace sublimit

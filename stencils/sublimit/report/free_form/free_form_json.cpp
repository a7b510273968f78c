// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/free_form_json.h"

#include <cmath>
#include <numbers>

#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/report/asset/asset_json.h"

namespace sublimit {
namespace {

using FreeFormJson = nlohmann::ordered_json;

constexpr double in_degrees = 180 / std::numbers::pi;

FreeFormJson number_json(double value) { return std::isfinite(value) ? FreeFormJson(value) : FreeFormJson(nullptr); }
FreeFormJson number_json(const std::optional<double>& value) {
  return value ? number_json(*value) : FreeFormJson(nullptr);
}
template <class Vector>
FreeFormJson point_json(const Vector& v) {
  return FreeFormJson::array({number_json(v[0]), number_json(v[1]), number_json(v[2])});
}

/// A point to what pictures need.
FreeFormJson drawn(const Eigen::Vector3d& v, double diagonal) {
  const double unit = diagonal > 0 && std::isfinite(diagonal) ? std::pow(10., 6 - std::floor(std::log10(diagonal))) : 1;
  const auto rounded = [&](double x) {
    const double scaled = std::round(x * unit) / unit;
    return std::isfinite(scaled) ? scaled : 0;
  };
  return FreeFormJson::array({rounded(v[0]), rounded(v[1]), rounded(v[2])});
}

template <class Range, class F>
FreeFormJson list_json(const Range& values, const F& f) {
  FreeFormJson j = FreeFormJson::array();
  for (const auto& value : values) j.push_back(f(value));
  return j;
}

FreeFormJson orders_json(const std::optional<JoinOrders>& orders) {
  if (!orders) return nullptr;
  return {{"c", orders->c},
          {"g", orders->g},
          {"same", orders->is_same},
          {"obstacle", name(orders->obstacle)},
          {"says", words_of(*orders)}};
}

FreeFormJson deviation_json(const JoinDeviation& d) {
  return {{"g0", number_json(d.gap)},
          {"g1_degrees", number_json(d.angle_degrees)},
          {"g2", number_json(d.curvature)},
          {"compared", d.compared}};
}

FreeFormJson verdict_json(const std::optional<JoinVerdict>& v) {
  if (!v) return nullptr;
  return {{"says", v->says},
          {"g", v->compared > 0 ? FreeFormJson(v->g) : FreeFormJson(nullptr)},
          {"compared", v->compared},
          {"exceptions", v->exceptions}};
}

FreeFormJson maximum_json(const std::optional<SeamMaximum>& found, double scale) {
  if (!found) return nullptr;
  return {{"value", number_json(scale * found->value)}, {"uv", {found->u, found->v}}, {"at", point_json(found->point)}};
}

/// The worst of a seam: what keeps it from a higher order.
const std::optional<SeamMaximum>& decisive(const PatchSeam& seam) {
  if (seam.measured && seam.measured->g < 0) return seam.gap;
  return seam.measured && seam.measured->g == 0 ? seam.angle : seam.curvature_jump;
}

FreeFormJson seam_json(const ReportedSeam& reported, const FreeFormReport& report) {
  const PatchSeam& seam = reported.seam;
  FreeFormJson j;
  j["kind"] = reported.is_gap ? "gap" : std::string(name(seam.kind));
  j["lines"] = list_json(seam.lines, [&](const PatchLine& line) {
    return FreeFormJson{{"patch", line.patch},
                        {line.along_v ? "u" : "v", free_form_detail::line_parameter(report.patches, line)}};
  });
  j["part"] = seam.part ? FreeFormJson(*seam.part) : FreeFormJson(nullptr);
  j["same_orientation"] = seam.is_compared() ? FreeFormJson(seam.same_orientation) : FreeFormJson(nullptr);
  j["columns_c"] = seam.columns_c ? FreeFormJson(*seam.columns_c) : FreeFormJson(nullptr);
  j["measured"] = orders_json(seam.measured);
  j["exact"] = orders_json(reported.exact);
  if (seam.kind == SeamKind::collapsed) j["tangent_plane"] = seam.has_plane ? "yes" : "no";
  if (seam.is_compared()) {
    j["g0"] = maximum_json(seam.gap, 1);
    j["g1_degrees"] = maximum_json(seam.angle, in_degrees);
    FreeFormJson jump = maximum_json(seam.curvature_jump, 1);
    j["g2"] = seam.curvature_jump ? number_json(free_form_detail::part_of_curvature(
                                        seam.curvature_jump->value, seam.greatest_curvature, report.diagonal()))
                                  : FreeFormJson(nullptr);
    j["curvature_jump"] = std::move(jump);
  }
  const auto& worst = decisive(seam);
  j["at"] = worst                    ? point_json(worst->point)
            : !reported.line.empty() ? point_json(reported.line[reported.line.size() / 2])
                                     : FreeFormJson(nullptr);
  j["points"] = list_json(reported.line, [&](const Eigen::Vector3d& p) { return drawn(p, report.diagonal()); });
  if (!reported.recipe.empty()) j["recipe"] = reported.recipe;
  return j;
}

FreeFormJson vertex_json(const SeamVertex& vertex) {
  FreeFormJson j;
  j["corners"] = list_json(vertex.corners, [](const PatchCorner& corner) {
    return FreeFormJson{{"patch", corner.patch}, {"u_end", corner.u_end}, {"v_end", corner.v_end}};
  });
  j["interior"] = vertex.is_interior;
  j["degenerate"] = vertex.is_degenerate;
  const bool filled = !vertex.is_degenerate;
  j["plane_angle_degrees"] = filled ? number_json(in_degrees * vertex.plane_angle) : FreeFormJson(nullptr);
  j["tangent_plane"] = !filled ? "unknown" : vertex.planes_agree ? "yes" : "no";
  j["twist_residual"] = number_json(vertex.twist_residual);
  j["enclosure"] = number_json(vertex.enclosure);
  j["can_be_enclosed"] = vertex.can_be_enclosed ? FreeFormJson(*vertex.can_be_enclosed) : FreeFormJson(nullptr);
  j["at"] = point_json(vertex.point);
  return j;
}

FreeFormJson joint_json(const FreeFormJoint& joint, const FreeFormReport& report) {
  const CurveJoin& found = joint.measured;
  const bool is_pole = found.orders.obstacle == JoinObstacle::pole;
  FreeFormJson j;
  j["kind"] = name(joint.kind);
  j["curves"] = {joint.left, joint.right};
  j["parameters"] = {joint.left_parameter, joint.right_parameter};
  j["reversed"] = {joint.left_reversed, joint.right_reversed};
  j["measured"] = orders_json(found.orders);
  j["exact"] = orders_json(joint.exact);
  j["g0"] = is_pole ? FreeFormJson(nullptr) : number_json(found.gap);
  j["g1_degrees"] = found.angle ? number_json(in_degrees * *found.angle) : FreeFormJson(nullptr);
  j["g2"] = found.curvature_jump ? number_json(free_form_detail::part_of_curvature(
                                       *found.curvature_jump, joint.greatest_curvature, report.diagonal()))
                                 : FreeFormJson(nullptr);
  j["curvature_jump"] = number_json(found.curvature_jump);
  j["ratios"] = list_json(found.ratios, [](double r) { return number_json(r); });
  j["at"] = is_pole ? FreeFormJson(nullptr) : point_json(joint.place);
  if (!joint.recipe.empty()) j["recipe"] = joint.recipe;
  return j;
}

/// Where an element is from: a line of the file, or a recipe.
FreeFormJson element_json(const std::vector<std::string>& recipes, size_t i, std::int64_t line) {
  if (recipes.empty()) return {{"line", line}};
  return {{"line", nullptr}, {"recipe", recipes[i]}};
}

FreeFormJson patch_json(const FreeFormReport& report, size_t p) {
  const FreeFormSurface& s = report.shapes.surfaces[p];
  const auto direction = [](const FreeFormDirection& d) {
    return FreeFormJson{{"degree", d.degree}, {"control_points", d.count}, {"range", {d.first, d.last}}};
  };
  FreeFormJson j = element_json(report.surface_recipes, p, s.line);
  j.update({{"basis", basis_name(s.basis)},
            {"rational", s.rational},
            {"u", direction(s.u)},
            {"v", direction(s.v)},
            {"faces", report.patches.patches[p].surface->num_faces()},
            {"converted", bool(report.patches.is_converted[p])},
            {"trims", s.loops.size()}});
  return j;
}

FreeFormJson curve_json_of(const FreeFormReport& report, size_t c) {
  const FreeFormCurve& curve = report.shapes.curves[c];
  const CurvePicture& picture = report.picture.curves[c];
  FreeFormJson pieces = FreeFormJson::array();
  for (size_t i = 0; i < picture.points.size(); ++i)
    pieces.push_back(
        {{"points", list_json(picture.points[i], [&](const auto& p) { return drawn(p, report.diagonal()); })},
         {"curvature", list_json(picture.curvature[i], [&](const auto& K) {
            return K && K->allFinite() ? point_json(*K) : FreeFormJson(nullptr);
          })}});
  FreeFormJson j = element_json(report.curve_recipes, c, curve.line);
  j.update({{"basis", basis_name(curve.basis)},
            {"rational", curve.rational},
            {"degree", curve.u.degree},
            {"control_points", curve.u.count},
            {"range", {curve.u.first, curve.u.last}},
            {"converted", report.curves[c].exact.empty()},
            {"pieces", std::move(pieces)}});
  return j;
}

FreeFormJson excess_json(const JoinExcess& e) {
  return {{e.is_joint ? "joint" : "seam", e.number},
          {"what", e.what},
          {"value", number_json(e.value)},
          {"at", point_json(e.place)}};
}

FreeFormJson warning_json(const FreeFormWarning& w, const FreeFormReport& report) {
  static constexpr const char* severities[] = {"error", "warning", "hint"};
  FreeFormJson j = {{"severity", severities[int(w.severity)]}, {"says", w.says}};
  std::string where = w.recipe;
  const auto first = [&](const char* what, size_t i, const auto& elements, const std::vector<std::string>& recipes) {
    where = what + std::to_string(i) +
            (recipes.empty() ? " (line " + std::to_string(elements[i].line) + ")" : ", " + recipes[i]);
  };
  if (!w.patches.empty())
    first("patch ", w.patches[0], report.shapes.surfaces, report.surface_recipes);
  else if (!w.curves.empty())
    first("curve ", w.curves[0], report.shapes.curves, report.curve_recipes);
  if (!where.empty() && w.count > 1) where += " and " + std::to_string(w.count - 1) + " more";
  j["where"] = where;
  j["count"] = w.count;
  if (!w.patches.empty()) j["patches"] = w.patches;
  if (!w.curves.empty()) j["curves"] = w.curves;
  j["at"] = w.place ? point_json(*w.place) : FreeFormJson(nullptr);
  j["advice"] = w.advice;
  return j;
}

/// How many seams there are of each kind, all kinds.
FreeFormJson kinds_json(const FreeFormReport& report) {
  FreeFormJson kinds = FreeFormJson::object();
  for (int k = 0; k <= int(SeamKind::boundary); ++k) kinds[std::string(name(SeamKind(k)))] = 0;
  kinds["gap"] = 0;
  for (const ReportedSeam& seam : report.seams) {
    FreeFormJson& count = kinds[seam.is_gap ? "gap" : std::string(name(seam.seam.kind))];
    count = count.get<int>() + 1;
  }
  return kinds;
}

}  // namespace

FreeFormJson to_json(const FreeFormReport& r, const std::string& file) {
  const auto counted = [](size_t count) {
    std::vector<size_t> numbers(count);
    for (size_t i = 0; i < count; ++i) numbers[i] = i;
    return numbers;
  };
  FreeFormJson j;
  j["file"] = file;
  j["counts"] = {
      {"surfaces", r.shapes.surfaces.size()}, {"curves", r.shapes.curves.size()}, {"mesh_faces", r.shapes.num_faces}};
  j["box"] = {point_json(r.box_min), point_json(r.box_max)};
  j["verdict"] = {{"seams", verdict_json(r.seam_verdict)}, {"joints", verdict_json(r.joint_verdict)}};
  const std::optional<double> g0 =
      r.tolerance.g0 && r.tolerance.g0_of_box ? *r.tolerance.g0 * r.diagonal() : r.tolerance.g0;
  j["tolerance"] = {{"g0", number_json(g0)},
                    {"g1_degrees", number_json(r.tolerance.g1_degrees)},
                    {"g2", number_json(r.tolerance.g2)}};
  j["within_tolerance"] = r.within_tolerance ? FreeFormJson(*r.within_tolerance) : FreeFormJson(nullptr);
  j["beyond"] = list_json(r.beyond, excess_json);
  j["patches"] = list_json(counted(r.shapes.surfaces.size()), [&](size_t p) { return patch_json(r, p); });
  FreeFormJson seams;
  seams["kinds"] = kinds_json(r);
  seams["smooth_lines"] = r.smooth_lines;
  seams["boundary_loops"] = r.boundary_loops;
  seams["deviation"] = deviation_json(r.seam_deviation);
  seams["list"] = list_json(r.seams, [&](const ReportedSeam& seam) { return seam_json(seam, r); });
  j["seams"] = std::move(seams);
  j["vertices"] = list_json(r.vertices, vertex_json);
  j["curves"] = list_json(counted(r.shapes.curves.size()), [&](size_t c) { return curve_json_of(r, c); });
  FreeFormJson joints;
  joints["free_ends"] = r.joints.free_ends;
  joints["branches"] = r.joints.branches;
  joints["deviation"] = deviation_json(r.joint_deviation);
  joints["list"] = list_json(r.joints.joints, [&](const FreeFormJoint& joint) { return joint_json(joint, r); });
  j["joints"] = std::move(joints);
  const AssetSurface& surface = r.picture.surface;
  j["surface"] = surface.positions.rows() > 0 ? surface_json(surface, r.diagonal()) : FreeFormJson(nullptr);
  j["isolines"] = r.picture.isolines;
  j["net"] = {{"points", list_json(counted(size_t(r.picture.net.rows())),
                                   [&](size_t i) {
                                     return drawn(r.picture.net.row(Eigen::Index(i)).transpose(), r.diagonal());
                                   })},
              {"edges", r.picture.net_edges}};
  j["warnings"] = list_json(r.warnings, [&](const FreeFormWarning& w) { return warning_json(w, r); });
  return j;
}

}  // namespace sublimit

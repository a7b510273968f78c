// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/asset_json.h"

#include <cmath>

namespace sublimit {
namespace {

using Json = nlohmann::ordered_json;

/// NaN and infinity have no word in JSON, and mean that there is no such number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

template <class Vector>
Json triple(const Vector& v) {
  return Json::array({number(v[0]), number(v[1]), number(v[2])});
}

/// To so many decimals; what pictures need, at half the size.
double rounded(double value, double unit) { return std::isfinite(value) ? std::round(value * unit) / unit : 0; }

/// To five digits.
double short_number(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double unit = std::pow(10., 4 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(unit) ? rounded(value, unit) : value;
}

Json deviation(const SeamDeviation& d) {
  return {{"g0", number(d.g0)}, {"g1_degrees", number(d.g1_degrees)}, {"g2", number(d.g2)}, {"compared", d.compared}};
}

Json excess(const SeamExcess& e) {
  Json j = Json::object();
  if (e.at == SeamExcess::At::edge) j["edge"] = e.edge;
  if (e.at == SeamExcess::At::patch) j["face"] = e.face;
  if (e.at == SeamExcess::At::point) j["vertex"] = e.edge[0];
  j["what"] = e.what;
  j["value"] = number(e.value);
  j["at"] = triple(e.place);
  return j;
}

Json kind(const AssetKind& k) {
  Json j = {{"kind", k.kind}, {"n", k.n}, {"count", k.count}, {"examples", k.examples}};
  if (!k.sides.empty()) j["sides"] = k.sides;
  if (k.verdict) {
    j["tangent_plane"] = name(k.verdict->plane);
    j["curvature"] = name(k.verdict->curvature);
    j["ratio"] = number(k.verdict->ratio);
    j["by"] = "floating";
  }
  if (k.sharpness) j["sharpness"] = *k.sharpness;
  return j;
}

Json range(const std::optional<CurvatureRange>& r) {
  if (!r) return nullptr;
  Json quantiles = Json::array();
  for (const double q : r->quantiles) quantiles.push_back(number(q));
  return {{"min", number(r->min)}, {"max", number(r->max)}, {"mean", number(r->mean)}, {"quantiles", quantiles}};
}

Json places(const std::vector<AssetPlace>& list) {
  Json j = Json::array();
  for (const AssetPlace& p : list)
    j.push_back(
        {{"what", p.what}, {"value", number(p.value)}, {"face", p.face}, {"uv", {p.u, p.v}}, {"at", triple(p.place)}});
  return j;
}

std::string where(const AssetWarning& w) {
  const bool is_face = !w.faces.empty();
  const std::vector<Index>& list = is_face ? w.faces : w.vertices;
  if (list.empty()) return "";
  std::string text =
      (is_face ? "face " : "vertex ") + std::to_string(list[0]) + " (1-based " + std::to_string(list[0] + 1) + ")";
  if (w.count > 1) text += " and " + std::to_string(w.count - 1) + " more";
  return text;
}

Json warning(const AssetWarning& w) {
  static constexpr const char* severities[] = {"error", "warning", "hint"};
  Json j = {{"severity", severities[int(w.severity)]}, {"says", w.says}, {"where", where(w)}, {"count", w.count}};
  if (!w.vertices.empty()) j["vertices"] = w.vertices;
  if (!w.faces.empty()) j["faces"] = w.faces;
  j["at"] = w.place ? triple(*w.place) : Json(nullptr);
  j["advice"] = w.advice;
  return j;
}

template <class T, class F>
Json list(const std::vector<T>& values, const F& f) {
  Json j = Json::array();
  for (const T& value : values) j.push_back(f(value));
  return j;
}

}  // namespace

Json surface_json(const AssetSurface& s, double diagonal) {
  const double unit = diagonal > 0 && std::isfinite(diagonal) ? std::pow(10., 6 - std::floor(std::log10(diagonal))) : 1;
  Json positions = Json::array(), normals = Json::array(), faces = Json::array(), curvature = Json::array();
  const auto row = [](const Points& m, Eigen::Index i, double u) {
    return Json::array({rounded(m(i, 0), u), rounded(m(i, 1), u), rounded(m(i, 2), u)});
  };
  for (Eigen::Index i = 0; i < s.positions.rows(); ++i) {
    positions.push_back(row(s.positions, i, std::isfinite(unit) ? unit : 1));
    normals.push_back(row(s.normals, i, 1e4));
    const auto& c = s.curvature[size_t(i)];
    curvature.push_back(c ? Json::array({short_number((*c)[0]), short_number((*c)[1])}) : Json(nullptr));
  }
  size_t at = 0;
  for (const Index size : s.face_sizes) {
    faces.push_back(std::vector<Index>(s.face_vertices.begin() + std::ptrdiff_t(at),
                                       s.face_vertices.begin() + std::ptrdiff_t(at + size_t(size))));
    at += size_t(size);
  }
  return {{"positions", positions}, {"faces", faces}, {"normals", normals}, {"curvature", curvature}};
}

Json to_json(const AssetReport& r, const std::string& file) {
  const AssetSeams& s = r.seams;
  const double diagonal = (r.box_max - r.box_min).norm();
  Json j;
  j["file"] = file;
  j["scheme"] = r.scheme;
  j["counts"] = {{"vertices", r.vertices}, {"faces", r.faces}, {"edges", r.edges}};
  j["box"] = {triple(r.box_min), triple(r.box_max)};
  j["inventory"] = list(r.inventory, kind);
  const std::optional<double> g0 =
      r.tolerance.g0 && r.tolerance.g0_of_box ? *r.tolerance.g0 * diagonal : r.tolerance.g0;
  Json seams;
  seams["tolerance"] = {
      {"g0", number(g0)}, {"g1_degrees", number(r.tolerance.g1_degrees)}, {"g2", number(r.tolerance.g2)}};
  seams["edges"] = s.edges;
  seams["crease_edges"] = s.crease_edges;
  seams["border_edges"] = s.border_edges;
  seams["inside"] = deviation(s.inside);
  seams["across_creases"] = deviation(s.across_creases);
  seams["around_points"] = deviation(s.around_points);
  seams["within_tolerance"] = s.within_tolerance ? Json(*s.within_tolerance) : Json(nullptr);
  seams["beyond"] = list(s.beyond, excess);
  seams["worst"] = list(s.worst, excess);
  j["seams"] = std::move(seams);
  const AssetCurvature& c = r.curvature;
  j["curvature"] = {{"gauss", range(c.gauss)},
                    {"mean", range(c.mean)},
                    {"unbounded_at", c.unbounded_at},
                    {"area", number(c.area)},
                    {"total_gauss", number(c.total_gauss)},
                    {"samples", c.samples},
                    {"without", c.without}};
  j["surface"] = r.surface.positions.rows() > 0 ? surface_json(r.surface, diagonal) : Json(nullptr);
  j["worst"] = places(r.worst);
  j["warnings"] = list(r.warnings, warning);
  return j;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
// What there is of free-form curves and surfaces in a file.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "support/free_form.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"

namespace sublimit::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Where pieces meet in one direction, and how smoothly the columns do there: k of C^k by multiplicity.
struct Joints {
  std::vector<std::pair<double, int>> all;  ///< parameter, k
};

Joints joints_of(FreeFormBasis basis, const FreeFormDirection& direction) {
  Joints joints;
  const std::vector<double>& t = direction.parameters;
  const auto [first, last] = free_form_domain(basis, direction);
  for (size_t i = 0; i < t.size();) {
    size_t end = i;
    while (end < t.size() && t[end] == t[i]) ++end;
    if (t[i] > first && t[i] < last) {
      int k = -2;  // of a basis matrix: as its entries make it
      if (basis == FreeFormBasis::bspline) k = direction.degree - static_cast<int>(end - i);
      if (basis == FreeFormBasis::bezier) k = 0;
      if (basis == FreeFormBasis::cardinal) k = 1;
      if (basis == FreeFormBasis::taylor) k = -1;
      joints.all.push_back({t[i], k});
    }
    i = end;
  }
  return joints;
}

std::string in_words(const Joints& joints) {
  if (joints.all.empty()) return "one piece";
  std::map<int, std::vector<double>> by_order;
  for (const auto& [t, k] : joints.all) by_order[k].push_back(t);
  std::string text;
  for (const auto& [k, places] : by_order) {
    text += (text.empty() ? "" : ", ") + (k == -2 ? std::string("joints") : fmt::format("C^{}", k)) + " at";
    constexpr size_t most = 6;
    for (size_t i = 0; i < std::min(most, places.size()); ++i) text += " " + format_number(places[i]);
    if (places.size() > most) text += fmt::format(" and {} more", places.size() - most);
  }
  return text;
}

std::string basis_words(const FreeFormElement& element) {
  return (element.rational ? "rat " : "") + std::string(basis_name(element.basis));
}

/// Smallest and largest weight of an element's points.
std::pair<double, double> weights_of(const FreeForm& shapes, const FreeFormElement& element) {
  double least = INFINITY, most = -INFINITY;
  for (const Index v : element.points) {
    least = std::min(least, shapes.weights[size_t(v)]);
    most = std::max(most, shapes.weights[size_t(v)]);
  }
  return {least, most};
}

/// Sides of the control net that are one point: "v = 0", ...
std::vector<std::string> collapsed_sides(const FreeForm& shapes, const FreeFormSurface& s) {
  std::vector<std::string> sides;
  const auto is_point = [&](Index first, Index step, Index count) {
    for (Index i = 1; i < count; ++i)
      if (shapes.vertices.row(s.points[size_t(first + i * step)]) != shapes.vertices.row(s.points[size_t(first)]))
        return false;
    return count > 1;
  };
  const Index m = s.u.count, n = s.v.count;
  const auto add = [&](const char* name, double at) {
    sides.push_back(fmt::format("{} = {}", name, format_number(at)));
  };
  if (is_point(0, 1, m)) add("v", s.v.first);
  if (is_point(m * (n - 1), 1, m)) add("v", s.v.last);
  if (is_point(0, m, n)) add("u", s.u.first);
  if (is_point(m - 1, m, n)) add("u", s.u.last);
  return sides;
}

std::array<size_t, 3> loops_of(const FreeFormSurface& s) {
  std::array<size_t, 3> counts{};
  for (const FreeFormLoop& loop : s.loops) ++counts[size_t(loop.kind)];
  return counts;
}

Json json_of(FreeFormBasis basis, const FreeFormDirection& d) {
  Json joints = Json::array();
  for (const auto& [t, k] : joints_of(basis, d).all)
    joints.push_back({{"at", t}, {"continuity", k == -2 ? Json() : Json(k)}});
  return {{"degree", d.degree},
          {"control_points", d.count},
          {"parameters", d.parameters},
          {"range", {d.first, d.last}},
          {"joints", joints}};
}

Json json_of(const FreeForm& shapes, const FreeFormElement& e) {
  const auto [least, most] = weights_of(shapes, e);
  Json json{{"line", e.line}, {"basis", basis_name(e.basis)}, {"rational", e.rational}};
  if (e.rational) json["weights"] = {least, most};
  return json;
}

void print_element(const FreeForm& shapes, const FreeFormElement& e) {
  if (!e.rational) return;
  const auto [least, most] = weights_of(shapes, e);
  fmt::print("    weights          {} to {}{}\n", format_number(least), format_number(most),
             least > 0 ? "" : ": not all positive, there may be poles");
}

Json as_json(const Common& common, const FreeForm& shapes) {
  const bool has_surfaces = !shapes.surfaces.empty();
  std::optional<FreeFormPatches> patches;
  if (has_surfaces) patches.emplace(free_form_patches(shapes, common.mesh));
  Json surfaces = Json::array(), curves = Json::array();
  for (size_t i = 0; i < shapes.surfaces.size(); ++i) {
    const FreeFormSurface& s = shapes.surfaces[i];
    const auto [trims, holes, curves_on] = loops_of(s);
    Json json = json_of(shapes, s);
    json["u"] = json_of(s.basis, s.u);
    json["v"] = json_of(s.basis, s.v);
    json["faces"] = {patches->patches.first_face(i), patches->patches.first_face(i + 1) - 1};
    json["collapsed_sides"] = collapsed_sides(shapes, s);
    json["trims"] = trims;
    json["holes"] = holes;
    json["special_curves"] = curves_on;
    surfaces.push_back(std::move(json));
  }
  for (const FreeFormCurve& c : shapes.curves) {
    Json json = json_of(shapes, c);
    json["t"] = json_of(c.basis, c.u);
    curves.push_back(std::move(json));
  }
  return {{"file", common.mesh},
          {"surfaces", surfaces},
          {"curves", curves},
          {"curves_in_parameter_space", shapes.curves_2d.size()},
          {"connections", shapes.connections.size()},
          {"mesh_faces", shapes.num_faces},
          {"warnings", shapes.warnings}};
}

}  // namespace

void print_free_form(const Common& common, const FreeForm& shapes, bool json,
                     const std::optional<LimitIntegrals>& integrals) {
  if (json) {
    nlohmann::ordered_json all = as_json(common, shapes);
    if (integrals) all["limit"] = to_json(*integrals);
    fmt::print("{}\n", all.dump(2));
    return;
  }
  std::optional<FreeFormPatches> patches;  // first: what is wrong with them is told alone
  if (!shapes.surfaces.empty()) patches.emplace(free_form_patches(shapes, common.mesh));
  fmt::print("{}\n  {} surfaces, {} curves, {} curves in parameter space, {} vertices\n", common.mesh,
             shapes.surfaces.size(), shapes.curves.size(), shapes.curves_2d.size(), shapes.vertices.rows());
  for (size_t i = 0; i < shapes.surfaces.size(); ++i) {
    const FreeFormSurface& s = shapes.surfaces[i];
    fmt::print("  surface {} (line {}): {} of degree {} x {}, {} x {} control points\n", i, s.line, basis_words(s),
               s.u.degree, s.v.degree, s.u.count, s.v.count);
    fmt::print("    faces            {} to {} of `sublimit sample`\n", patches->patches.first_face(i),
               patches->patches.first_face(i + 1) - 1);
    for (const auto& [name, d] : {std::pair("u", &s.u), std::pair("v", &s.v)})
      fmt::print("    {}                {} to {}: {}\n", name, format_number(d->first), format_number(d->last),
                 in_words(joints_of(s.basis, *d)));
    print_element(shapes, s);
    for (const std::string& side : collapsed_sides(shapes, s)) fmt::print("    one point        the side {}\n", side);
    if (const auto [trims, holes, special] = loops_of(s); trims + holes + special > 0)
      fmt::print("    on it            {} trims, {} holes, {} special curves: kept, evaluated untrimmed\n", trims,
                 holes, special);
  }
  for (size_t i = 0; i < shapes.curves.size(); ++i) {
    const FreeFormCurve& c = shapes.curves[i];
    fmt::print("  curve {} (line {}): {} of degree {}, {} control points\n", i, c.line, basis_words(c), c.u.degree,
               c.u.count);
    fmt::print("    t                {} to {}: {}\n", format_number(c.u.first), format_number(c.u.last),
               in_words(joints_of(c.basis, c.u)));
    print_element(shapes, c);
  }
  if (shapes.num_faces > 0) fmt::print("  and a mesh of {} faces, below\n", shapes.num_faces);
  for (const std::string& warning : shapes.warnings) fmt::print("  warning: {}\n", warning);
}

}  // namespace sublimit::cli

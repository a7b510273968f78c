// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "commands/gallery.h"
#include "support/manual.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"

namespace sublimit::cli {
namespace {

const char* faces(const Scheme<double>& scheme) { return scheme.face_size() == 3 ? "triangles" : "any"; }

/// Edges are this many times shorter after a level.
nlohmann::ordered_json arity(const Scheme<double>& scheme) {
  switch (scheme.steps[0].split) {
    case Split::sqrt3:
      return "sqrt(3)";
    case Split::mid_edge:
      return "sqrt(2)";
    default:
      return 2;
  }
}

std::string other_claims(const Claims& claims) {
  std::string text = fmt::format("degree {}", claims.reproduces);
  if (claims.generates != claims.reproduces) text += fmt::format(", generates {}", claims.generates);
  if (claims.interpolates) text += ", interpolates";
  if (claims.convex_hull) text += ", convex hull";
  return text;
}

nlohmann::ordered_json to_json(const OptionInfo& info) {
  nlohmann::ordered_json json{{"default", info.values.front()}, {"meaning", info.meaning}};
  if (info.range) {
    json["type"] = info.range->whole ? "whole number" : "number";
    json["from"] = to_string(info.range->low);
    json["to"] = to_string(info.range->high);
  } else {
    json["type"] = "word";
    json["values"] = info.values;
  }
  return json;
}

nlohmann::ordered_json to_json(const std::vector<OptionInfo>& options) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const OptionInfo& info : options) json[info.name] = to_json(info);
  return json;
}

void print(const OptionInfo& info) {
  std::string values;
  for (const std::string& value : info.values) values += (values.empty() ? "" : "|") + value;
  if (info.range) values = to_string(info.range->low) + ".." + to_string(info.range->high);
  fmt::print("{:<21}   --option {}={} (default {}){}{}\n", "", info.name, values, info.values.front(),
             info.meaning.empty() ? "" : ": ", info.meaning);
}

/// `null` for what is not claimed.
template <class Data>
void add_geometric(nlohmann::ordered_json& all, const GeometricScheme<Data>& scheme, const char* kind,
                   const char* split) {
  const GeometricClaims& claims = scheme.claims;
  nlohmann::ordered_json continuity;
  if (claims.regular) continuity = *claims.regular;
  all.push_back({{"name", scheme.name},
                 {"kind", kind},
                 {"linear", false},
                 {"arity", 2},
                 {"splits", {split}},
                 {"limit", claims.limit},
                 {"geometric_continuity", continuity},
                 {"exponent", claims.exponent},
                 {"reproduces", claims.reproduces},
                 {"interpolates", claims.interpolates},
                 {"convex_hull", false},
                 {"options", to_json(scheme.options)},
                 {"source", scheme.source}});
}

void add_curves(nlohmann::ordered_json& all) {
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    const CurveClaims& claims = scheme.claims;
    all.push_back({{"name", scheme.name},
                   {"kind", "curve"},
                   {"arity", 2},
                   {"splits", {scheme.masks.dual() ? "dual" : "primal"}},
                   {"limit", claims.limit},
                   {"regular_continuity", claims.regular},
                   {"exponent", claims.exponent},
                   {"generates_degree", claims.generates},
                   {"reproduces_degree", claims.reproduces},
                   {"interpolates", claims.interpolates},
                   {"convex_hull", claims.convex_hull},
                   {"options", to_json(scheme.options)},
                   {"source", scheme.source}});
  }
  for (const GeometricCurveScheme& scheme : all_geometric_schemes()) add_geometric(all, scheme, "curve", "primal");
  for (const GeometricSurfaceScheme& scheme : all_geometric_schemes<CurvatureMesh>())
    add_geometric(all, scheme, "surface", name(Split::ptq));
  for (const GeometricNormalScheme& scheme : all_geometric_schemes<NormalMesh>())
    add_geometric(all, scheme, "surface", name(Split::ptq));
}

void print_curves() {
  fmt::print("\n{:<19} {:<6} {:<7} {:<30} {:<8} {:<14} {:<34} {}\n", "scheme", "kind", "split", "limit", "smooth",
             "exponent", "claims", "source");
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    const CurveClaims& claims = scheme.claims;
    std::string text = fmt::format("degree {}", claims.reproduces);
    if (claims.generates != claims.reproduces) text += fmt::format(", generates {}", claims.generates);
    if (claims.interpolates) text += ", interpolates";
    if (claims.convex_hull) text += ", convex hull";
    fmt::print("{:<19} {:<6} {:<7} {:<30} C^{:<6} {:<14} {:<34} {}\n", scheme.name, "curve",
               scheme.masks.dual() ? "dual" : "primal", claims.limit, claims.regular, claims.exponent, text,
               scheme.source);
    for (const OptionInfo& info : scheme.options) print(info);
  }
  for (const GeometricCurveScheme& scheme : all_geometric_schemes()) {
    const GeometricClaims& claims = scheme.claims;
    const std::string text = claims.reproduces + (claims.interpolates ? ", interpolates" : "") + ", not linear";
    fmt::print("{:<19} {:<6} {:<7} {:<30} G^{:<6} {:<14} {:<34} {}\n", scheme.name, "curve", "primal", claims.limit,
               claims.regular.value_or(0), claims.exponent, text, scheme.source);
  }
  fmt::print(
      "\nNot linear: no matrix; points with unit tangents in a CSV x,y,tx,ty or x,y,z,tx,ty,tz. G: by arc length.\n");
  for (const GeometricSurfaceScheme& scheme : all_geometric_schemes<CurvatureMesh>()) {
    fmt::print(
        "\n{:<19} surface through points with normals and curvatures, triangles, not linear; interpolates; {}: {}\n",
        scheme.name, scheme.claims.reproduces, scheme.source);
    for (const OptionInfo& info : scheme.options) print(info);
  }
  for (const GeometricNormalScheme& scheme : all_geometric_schemes<NormalMesh>()) {
    fmt::print("\n{:<19} surface through points with normals (vn), triangles, G^{}, not linear; {}; interpolates: {}\n",
               scheme.name, scheme.claims.regular.value_or(0), scheme.claims.limit, scheme.source);
    for (const OptionInfo& info : scheme.options) print(info);
  }
}

int run(bool as_json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  if (!as_json)
    fmt::print("{:<21} {:<8} {:<8} {:<10} {:<24} {:<8} {:<14} {:<34} {}\n", "scheme", "kind", "split", "faces",
               "regular limit", "regular", "extraordinary", "claims", "source");
  for (const Scheme<double>& scheme : all_schemes()) {
    const Claims& claims = scheme.claims;
    if (as_json) {
      nlohmann::ordered_json steps = nlohmann::ordered_json::array();
      for (const Step<double>& step : scheme.steps) steps.push_back(name(step.split));
      all.push_back({{"name", scheme.name},
                     {"kind", "surface"},
                     {"arity", arity(scheme)},
                     {"splits", steps},
                     {"faces", faces(scheme)},
                     {"limit", claims.limit},
                     {"regular_continuity", claims.regular},
                     {"extraordinary_continuity", claims.extraordinary},
                     {"generates_degree", claims.generates},
                     {"reproduces_degree", claims.reproduces},
                     {"interpolates", claims.interpolates},
                     {"convex_hull", claims.convex_hull},
                     {"options", to_json(scheme.options)},
                     {"source", scheme.source}});
      continue;
    }
    fmt::print("{:<21} {:<8} {:<8} {:<10} {:<24} C^{:<6} C^{:<12} {:<34} {}\n", scheme.name, "surface",
               name(scheme.steps[0].split), faces(scheme), claims.limit, claims.regular, claims.extraordinary,
               other_claims(claims), scheme.source);
    for (const OptionInfo& info : scheme.options) print(info);
  }
  if (as_json) {
    add_curves(all);
    fmt::print("{}\n", all.dump(2));
    return 0;
  }
  fmt::print(
      "\npqq: an n-gon becomes n quads; ptq: a triangle becomes four; dqq: faces for faces, edges and vertices; these "
      "are of\n"
      "arity 2 (edges are half as long). mid-edge: faces for faces and vertices, arity sqrt(2); sqrt3: a triangle becomes\n"
      "three and old edges flip, arity sqrt(3). regular, extraordinary: smoothness of the limit there; degree: of the\n"
      "polynomials that regular meshes reproduce; convex hull: no negative weights. Faces: --triangulate makes triangles.\n");
  print_curves();
  return 0;
}

}  // namespace

std::vector<std::pair<std::string, std::vector<OptionInfo>>> scheme_words() {
  std::vector<std::pair<std::string, std::vector<OptionInfo>>> all;
  const auto add = [&](const auto& schemes) {
    for (const auto& scheme : schemes) all.emplace_back(scheme.name, scheme.options);
  };
  add(all_schemes());
  add(all_curve_schemes());
  add(all_geometric_schemes());
  add(all_geometric_schemes<CurvatureMesh>());
  add(all_geometric_schemes<NormalMesh>());
  return all;
}

Command add_schemes(CLI::App& app) {
  auto* command =
      app.add_subcommand("schemes", "List every scheme with its split, faces, limit, smoothness and source");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As JSON");
  const auto gallery = add_gallery(*command);
  command->footer(
      "Examples:\n  sublimit schemes\n  sublimit schemes --json\n"
      "  sublimit schemes --gallery out/gallery    # then open out/gallery/index.html");
  return [=] {
    if (gallery->directory.empty()) return run(*as_json);
    draw_gallery(*gallery, *as_json);
    return *as_json ? run(true) : 0;
  };
}

}  // namespace sublimit::cli

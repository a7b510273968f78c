// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "common.h"

namespace sublimit::cli {
namespace {

const char* faces(const Scheme<double>& scheme) { return scheme.face_size() == 3 ? "triangles" : "any"; }

std::string other_claims(const Claims& claims) {
  std::string text = fmt::format("degree {}", claims.reproduces);
  if (claims.interpolates) text += ", interpolates";
  if (claims.convex_hull) text += ", convex hull";
  return text;
}

int run(bool as_json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  if (!as_json)
    fmt::print("{:<15} {:<8} {:<6} {:<10} {:<18} {:<8} {:<14} {:<34} {}\n", "scheme", "kind", "split", "faces",
               "regular limit", "regular", "extraordinary", "claims", "source");
  for (const Scheme<double>& scheme : all_schemes()) {
    const Claims& claims = scheme.claims;
    if (as_json) {
      nlohmann::ordered_json steps = nlohmann::ordered_json::array(), options = nlohmann::ordered_json::object();
      for (const Step<double>& step : scheme.steps) steps.push_back(name(step.split));
      for (const OptionInfo& info : scheme.options) options[info.name] = info.values;
      all.push_back({{"name", scheme.name},
                     {"kind", "surface"},
                     {"arity", 2},
                     {"splits", steps},
                     {"faces", faces(scheme)},
                     {"limit", claims.limit},
                     {"regular_continuity", claims.regular},
                     {"extraordinary_continuity", claims.extraordinary},
                     {"reproduces_degree", claims.reproduces},
                     {"interpolates", claims.interpolates},
                     {"convex_hull", claims.convex_hull},
                     {"options", options},
                     {"source", scheme.source}});
      continue;
    }
    fmt::print("{:<15} {:<8} {:<6} {:<10} {:<18} C^{:<6} C^{:<12} {:<34} {}\n", scheme.name, "surface",
               name(scheme.steps[0].split), faces(scheme), claims.limit, claims.regular, claims.extraordinary,
               other_claims(claims), scheme.source);
    for (const OptionInfo& info : scheme.options) {
      std::string values;
      for (const std::string& value : info.values) values += (values.empty() ? "" : "|") + value;
      fmt::print("{:<15}   --option {}={} (default {})\n", "", info.name, values, info.values.front());
    }
  }
  if (as_json) {
    fmt::print("{}\n", all.dump(2));
    return 0;
  }
  fmt::print(
      "\npqq: an n-gon becomes n quads; ptq: a triangle becomes four; both of arity 2. regular, extraordinary: smoothness of\n"
      "the limit there; degree: of the polynomials that regular meshes reproduce; convex hull: no negative weights.\n");
  return 0;
}

}  // namespace

Command add_schemes(CLI::App& app) {
  auto* command = app.add_subcommand("schemes", "Every scheme: split, faces, limit, smoothness, source");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As JSON");
  command->footer("Examples:\n  sublimit schemes\n  sublimit schemes --json");
  return [=] { return run(*as_json); };
}

}  // namespace sublimit::cli

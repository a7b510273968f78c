// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes/schemes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"

namespace sublimit {

template std::vector<Scheme<double>> all_schemes<double>();
template std::optional<Scheme<double>> find_scheme<double>(const std::string&, const SchemeOptions&);
template std::vector<CurveScheme<double>> all_curve_schemes<double>();
template std::optional<CurveScheme<double>> find_curve_scheme<double>(const std::string&, const SchemeOptions&);

namespace {

template <class Registry>
std::vector<std::string> names_in(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& entry : registry) names.emplace_back(entry.name);
  return names;
}

/// A registry, in words that follow a name of one of its schemes, and what makes them.
struct NamedRegistry {
  SchemeKind kind;
  const char* refines;
  const char* function;
  std::vector<std::string> names;
};

std::vector<NamedRegistry> registries() {
  return {{SchemeKind::surface, "surfaces", "scheme", names_in(registry<double>)},
          {SchemeKind::curve, "curves", "curve_scheme", names_in(curve_registry<double>)},
          {SchemeKind::polygon, "curves with tangents, without a matrix", "geometric_scheme<ControlPolygon>",
           names_in(geometric_registry<ControlPolygon>)},
          {SchemeKind::curvature_mesh, "points with normals and curvatures, without a matrix",
           "geometric_scheme<CurvatureMesh>", names_in(geometric_registry<CurvatureMesh>)},
          {SchemeKind::normal_mesh, "points with normals, without a matrix", "geometric_scheme<NormalMesh>",
           names_in(geometric_registry<NormalMesh>)}};
}

}  // namespace

std::vector<std::string> nearest_scheme_names(const std::string& name, int count) {
  std::vector<std::string> names;
  for (NamedRegistry& one : registries()) std::ranges::move(one.names, std::back_inserter(names));
  return nearest_names(name, std::move(names), count);
}

void throw_unknown_scheme(const std::string& name, SchemeKind wanted) {
  const std::vector<NamedRegistry> all = registries();
  const NamedRegistry& asked = *std::ranges::find(all, wanted, &NamedRegistry::kind);
  for (const NamedRegistry& other : all)
    if (std::ranges::find(other.names, name) != other.names.end())
      throw InvalidOption("'" + name + "' is a scheme of " + other.refines + ", which " + other.function + "(\"" +
                          name + "\") makes; " + asked.function + " makes those of " + asked.refines);
  throw InvalidOption("unknown scheme '" + name + "' of " + asked.refines + "; " + nearest_in_words(name, asked.names));
}

void throw_no_surface_scheme(const std::string& name) {
  std::vector<std::string> names;
  for (const NamedRegistry& one : registries()) {
    names.insert(names.end(), one.names.begin(), one.names.end());
    if (std::ranges::find(one.names, name) == one.names.end()) continue;
    switch (one.kind) {
      case SchemeKind::curve:
      case SchemeKind::polygon:
        throw InvalidOption(name + " refines curves; a scheme of surfaces is needed here (`schemes` lists all)");
      case SchemeKind::curvature_mesh:
        throw InvalidOption(name + " refines points with normals and curvatures; it is for `sublimit fit`");
      case SchemeKind::normal_mesh:
        throw InvalidOption(name +
                            " makes surfaces through points with normals and has no matrix; it is for "
                            "`sublimit sample`, `refine`, `limit` and `info`");
      default:
        break;
    }
  }
  const std::vector<std::string> near = nearest_names(name, names);
  throw InvalidOption("unknown scheme '" + name + "'; " +
                      (near.empty() ? "`schemes` lists all" : nearest_in_words(name, near) + " (`schemes` lists all)"));
}

}  // namespace sublimit

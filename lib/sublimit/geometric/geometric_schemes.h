// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry of schemes without a matrix: a list for each kind of data, with one line per scheme.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/core/detail/unknown_scheme.h"
#include "sublimit/geometric/hermite_incentre.h"
#include "sublimit/geometric/nielson.h"
#include "sublimit/geometric/piper.h"
#include "sublimit/geometric/torus_pieces.h"

namespace sublimit {

template <class Data>
struct GeometricSchemeEntry {
  const char* name;
  GeometricScheme<Data> (*make)(const SchemeOptions&);
};

/// The list of schemes, and the kind of schemes, for a type of data. Specialised for every type.
template <class Data>
inline constexpr void* geometric_registry = nullptr;
template <class Data>
inline constexpr SchemeKind geometric_kind = SchemeKind::polygon;
template <>
inline constexpr SchemeKind geometric_kind<CurvatureMesh> = SchemeKind::curvature_mesh;
template <>
inline constexpr SchemeKind geometric_kind<NormalMesh> = SchemeKind::normal_mesh;
template <>
inline constexpr GeometricSchemeEntry<ControlPolygon> geometric_registry<ControlPolygon>[] = {
    {"hermite-incentre", hermite_incentre},
};
template <>
inline constexpr GeometricSchemeEntry<CurvatureMesh> geometric_registry<CurvatureMesh>[] = {
    {"torus-pieces", torus_pieces},
};
template <>
inline constexpr GeometricSchemeEntry<NormalMesh> geometric_registry<NormalMesh>[] = {
    {"nielson", nielson},
    {"piper", piper},
};

/// Returns every scheme for this kind of data with its default options.
template <class Data = ControlPolygon>
std::vector<GeometricScheme<Data>> all_geometric_schemes() {
  std::vector<GeometricScheme<Data>> schemes;
  for (const GeometricSchemeEntry<Data>& entry : geometric_registry<Data>) schemes.push_back(entry.make({}));
  return schemes;
}

/// Returns a scheme by name, or nothing if there is none. `geometric_scheme` below throws instead.
/// @throws InvalidOption  an unknown option, or a value outside its range
template <class Data = ControlPolygon>
[[nodiscard]] std::optional<GeometricScheme<Data>> find_geometric_scheme(const std::string& name,
                                                                         const SchemeOptions& options = {}) {
  for (const GeometricSchemeEntry<Data>& entry : geometric_registry<Data>) {
    if (name != entry.name) continue;
    check_options(name, entry.make({}).options, options);
    return entry.make(options);
  }
  return std::nullopt;
}

/// Returns a scheme by name: `geometric_scheme("hermite-incentre")`,
/// `geometric_scheme<CurvatureMesh>("torus-pieces")`.
/// @throws InvalidOption  no scheme for this kind of data has this name (names the nearest ones, or the
///                        function that makes it); an unknown option, or a value outside its range
template <class Data = ControlPolygon>
[[nodiscard]] GeometricScheme<Data> geometric_scheme(const std::string& name, const SchemeOptions& options = {}) {
  if (std::optional<GeometricScheme<Data>> found = find_geometric_scheme<Data>(name, options)) return *std::move(found);
  throw_unknown_scheme(name, geometric_kind<Data>);
}

}  // namespace sublimit

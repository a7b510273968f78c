// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry of curve schemes: one line per scheme.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/core/detail/unknown_scheme.h"
#include "sublimit/curves/schemes/chaikin.h"
#include "sublimit/curves/schemes/four_point.h"
#include "sublimit/curves/schemes/hermite_merrien.h"
#include "sublimit/curves/schemes/lane_riesenfeld.h"
#include "sublimit/curves/schemes/six_point.h"
#include "sublimit/curves/schemes/trigonometric_cubic.h"

namespace sublimit {

template <class T>
struct CurveSchemeEntry {
  const char* name;
  CurveScheme<T> (*make)(const SchemeOptions&);
};

template <class T>
inline constexpr CurveSchemeEntry<T> curve_registry[] = {
    {"chaikin", chaikin<T>},
    {"lane-riesenfeld", lane_riesenfeld<T>},
    {"four-point", four_point<T>},
    {"six-point", six_point<T>},
    {"trigonometric-cubic", trigonometric_cubic<T>},
    {"hermite-merrien", hermite_merrien<T>},
};

/// Returns every curve scheme with its default options.
template <class T = double>
[[nodiscard]] std::vector<CurveScheme<T>> all_curve_schemes() {
  std::vector<CurveScheme<T>> schemes;
  for (const CurveSchemeEntry<T>& entry : curve_registry<T>) schemes.push_back(entry.make({}));
  return schemes;
}

/// Returns a curve scheme by name, or nothing if there is none. `curve_scheme` below throws instead.
/// @throws InvalidOption  an unknown option, or a value outside its range
template <class T = double>
[[nodiscard]] std::optional<CurveScheme<T>> find_curve_scheme(const std::string& name,
                                                              const SchemeOptions& options = {}) {
  for (const CurveSchemeEntry<T>& entry : curve_registry<T>) {
    if (name != entry.name) continue;
    check_options(name, entry.make({}).options, options);
    return entry.make(options);
  }
  return std::nullopt;
}

/// Returns a curve scheme by name: `curve_scheme("chaikin")`, `curve_scheme("four-point", {{"tension",
/// "3/4"}})`.
/// @throws InvalidOption  no linear curve scheme has this name (names the nearest ones, or the function that
///                        makes it); an unknown option, or a value outside its range
template <class T = double>
[[nodiscard]] CurveScheme<T> curve_scheme(const std::string& name, const SchemeOptions& options = {}) {
  if (std::optional<CurveScheme<T>> found = find_curve_scheme<T>(name, options)) return *std::move(found);
  throw_unknown_scheme(name, SchemeKind::curve);
}

// Instantiated once, in the library, like the registry of surfaces.
extern template std::vector<CurveScheme<double>> all_curve_schemes<double>();
extern template std::optional<CurveScheme<double>> find_curve_scheme<double>(const std::string&, const SchemeOptions&);

}  // namespace sublimit

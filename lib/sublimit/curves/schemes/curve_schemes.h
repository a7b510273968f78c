// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry of curve schemes: one line a scheme.
#include <optional>

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

/// Every curve scheme with its default options.
template <class T = double>
std::vector<CurveScheme<T>> all_curve_schemes() {
  std::vector<CurveScheme<T>> schemes;
  for (const CurveSchemeEntry<T>& entry : curve_registry<T>) schemes.push_back(entry.make({}));
  return schemes;
}

/// A curve scheme by name; nothing if there is none.
/// @throws InvalidOption  an unknown option, or a value outside its range
template <class T = double>
std::optional<CurveScheme<T>> find_curve_scheme(const std::string& name, const SchemeOptions& options = {}) {
  for (const CurveSchemeEntry<T>& entry : curve_registry<T>) {
    if (name != entry.name) continue;
    check_options(name, entry.make({}).options, options);
    return entry.make(options);
  }
  return std::nullopt;
}

// Made once, in the library, as the registry of surfaces is.
extern template std::vector<CurveScheme<double>> all_curve_schemes<double>();
extern template std::optional<CurveScheme<double>> find_curve_scheme<double>(const std::string&, const SchemeOptions&);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes.h"

#include <utility>

#include "sublimit/core/nearest_names.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"

namespace sublimit {

template std::vector<Scheme<double>> all_schemes<double>();
template std::optional<Scheme<double>> find_scheme<double>(const std::string&, const SchemeOptions&);
template std::vector<CurveScheme<double>> all_curve_schemes<double>();
template std::optional<CurveScheme<double>> find_curve_scheme<double>(const std::string&, const SchemeOptions&);

std::vector<std::string> nearest_scheme_names(const std::string& name, int count) {
  std::vector<std::string> names;
  for (const SchemeEntry<double>& entry : registry<double>) names.push_back(entry.name);
  for (const CurveSchemeEntry<double>& entry : curve_registry<double>) names.push_back(entry.name);
  for (const auto& entry : geometric_registry<ControlPolygon>) names.push_back(entry.name);
  for (const auto& entry : geometric_registry<CurvatureMesh>) names.push_back(entry.name);
  for (const auto& entry : geometric_registry<NormalMesh>) names.push_back(entry.name);
  return nearest_names(name, std::move(names), count);
}

}  // namespace sublimit

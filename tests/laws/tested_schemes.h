// SPDX-License-Identifier: Apache-2.0
#pragma once
// The schemes for which laws of limit surfaces are tested: every registered scheme, and averaging with its
// degrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "laws/full_sweep.h"
#include "meshes/hard_meshes.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {

struct TestedScheme {
  std::string name;
  SchemeOptions options;

  template <class T = double>
  Scheme<T> scheme() const {
    return find_scheme<T>(name, options).value();
  }
  friend std::ostream& operator<<(std::ostream& out, const TestedScheme& t) {
    out << t.name;
    for (const auto& [key, value] : t.options) out << " " << key << "=" << value;
    return out;
  }
};

/// Returns the schemes. Averaging beyond degree 3, kobbelt and interpolatory-sqrt3 are included only in the
/// full sweep, since their types are large and take a minute each.
/// @param largest  largest degree of averaging
inline std::vector<TestedScheme> schemes_and_degrees(int largest = 9) {
  const bool full = full_sweep();
  if (!full) largest = std::min(largest, 3);
  std::vector<TestedScheme> tested;
  for (const Scheme<double>& scheme : all_schemes())
    if (scheme.name != "averaging" && (full || (scheme.name != "kobbelt" && scheme.name != "interpolatory-sqrt3")))
      tested.push_back({scheme.name, {}});
  for (int degree = 2; degree <= largest; ++degree)
    tested.push_back({"averaging", {{"degree", std::to_string(degree)}}});
  return tested;
}

/// Returns the schemes for which `wanted` is true.
template <class Wanted>
std::vector<TestedScheme> schemes_and_degrees_if(const Wanted& wanted) {
  std::vector<TestedScheme> tested = schemes_and_degrees();
  std::erase_if(tested, [&](const TestedScheme& t) { return !wanted(t.scheme()); });
  return tested;
}

/// Returns the name of a test: catmull_clark, averaging_5.
inline std::string test_name(const ::testing::TestParamInfo<TestedScheme>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  for (const auto& [key, value] : info.param.options) name += "_" + value;
  return name;
}

inline bool takes_triangles(const Scheme<double>& scheme) { return scheme.face_size() == 3; }
/// Returns true if the regular pieces of a scheme are polynomials.
inline bool has_polynomials(const Scheme<double>& scheme) { return !scheme.claims.limit.starts_with("no "); }

/// Returns a factor of the time for reference values and for analysing pieces, which is large for long products
/// of averages.
inline int effort(const Scheme<double>& scheme) {
  const int steps = static_cast<int>(scheme.steps.size());
  return steps <= 2 ? 1 : steps * steps;
}

/// Returns hard meshes for a scheme: closed, with borders, and with all kinds of sharp edges that it allows.
inline std::vector<Mesh> hard_meshes(const Scheme<double>& scheme, unsigned seed) {
  std::vector<Hardness> kinds{{}, {.open = true}};
  if (scheme.sharpening != Sharpening::boundary) kinds.push_back({.open = true, .sharp = true});
  if (scheme.sharpening == Sharpening::semi_sharp) kinds.push_back({.open = true, .semi_sharp = true});
  std::vector<Mesh> meshes;
  for (const Hardness& kind : kinds)
    meshes.push_back(takes_triangles(scheme) ? hard_triangles(seed, kind) : hard_polygons(seed, kind));
  return meshes;
}

}  // namespace sublimit::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types of isolated centres among regular points, at which laws are checked.
#include <vector>

#include "sublimit/neighborhood/local_type.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::testing {

/// Returns the type of an interior vertex, or of a face in dual schemes.
inline LocalType smooth_type(const Scheme<double>& scheme, int n) {
  return {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n};
}

/// Returns the types of border vertices of m faces in every phase, smooth ones and corners (except where dual
/// schemes round them), and of border edges.
inline std::vector<LocalType> border_types(const Scheme<double>& scheme, int m) {
  std::vector<LocalType> types;
  for (int phase = 0; phase < scheme.period; ++phase)
    for (const bool corner : {false, true})
      if (!corner || !scheme.is_dual())
        types.push_back({.kind = Centre::Kind::vertex, .faces = m, .open = true, .corner = corner, .phase = phase});
  types.push_back({.kind = Centre::Kind::border, .faces = 0});
  return types;
}

}  // namespace sublimit::testing

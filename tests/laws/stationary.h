// SPDX-License-Identifier: Apache-2.0
#pragma once
// Test whether the masks of a curve scheme are equal on all levels, by computing them.
#include "sublimit/curves/curve_scheme.h"

namespace sublimit::testing {

/// True if levels 0 and 1 have the same weights.
template <class T>
bool is_stationary(const CurveScheme<T>& scheme) {
  const int unknowns = scheme.masks.unknowns();
  for (int which = 0; which < 2; ++which)
    for (int component = 0; component < unknowns; ++component) {
      const auto& mask = scheme.masks.child(which, component);
      if (mask(CurveSite<T>(0, unknowns)).terms() != mask(CurveSite<T>(1, unknowns)).terms()) return false;
    }
  return true;
}

}  // namespace sublimit::testing

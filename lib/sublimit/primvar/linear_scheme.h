// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear scheme on another scheme's split: vertices are kept, edges get midpoints, and faces centroids. On
// pqq it is bilinear subdivision; on ptq the limit is the triangles themselves.
#include "sublimit/schemes/bilinear.h"

namespace sublimit {

/// True if vertices and edges survive the split, so that values can be linear along edges.
constexpr bool keeps_elements(Split split) { return is_primal(split) || split == Split::keep; }

template <class T>
bool keeps_elements(const std::vector<Step<T>>& steps) {
  return std::all_of(steps.begin(), steps.end(), [](const Step<T>& step) { return keeps_elements(step.split); });
}

/// Returns the linear scheme.
/// @pre  every step is primal
template <class T>
Scheme<T> linear_scheme(const Scheme<T>& scheme) {
  Scheme<T> linear = bilinear<T>({});
  const Step<T> pqq = linear.steps[0];
  const auto on_split = [&](const std::vector<Step<T>>& steps) {
    std::vector<Step<T>> result;
    for (const Step<T>& step : steps) {
      result.push_back(pqq);
      result.back().split = step.split;
      if (step.split == Split::pqq) continue;
      result.back().masks.face = {};
      if (step.split == Split::keep) result.back().masks.edge = {};
    }
    return result;
  };
  const bool is_bilinear =
      scheme.steps.size() == 1 && scheme.steps[0].split == Split::pqq && scheme.preparation.empty();
  if (is_bilinear) return linear;
  linear.name = "linear";
  linear.steps = on_split(scheme.steps);
  linear.preparation = on_split(scheme.preparation);
  linear.corners = scheme.corners;
  linear.claims.limit = "the faces";
  return linear;
}

}  // namespace sublimit

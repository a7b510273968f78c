// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of schemes, to decide whether limits computed for one are valid for the other.
#include <algorithm>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// True if two masks have the same function type. Captured values are not compared.
template <class Function>
bool is_alike(const Function& a, const Function& b) {
  return a.target_type() == b.target_type();
}
template <class T>
bool is_alike(const CreaseMasks<T>& a, const CreaseMasks<T>& b) {
  return is_alike(a.vertex, b.vertex) && is_alike(a.edge, b.edge);
}
template <class T>
bool is_alike(const Step<T>& a, const Step<T>& b) {
  return a.split == b.split && is_alike(a.masks.vertex, b.masks.vertex) && is_alike(a.masks.edge, b.masks.edge) &&
         is_alike(a.masks.face, b.masks.face) && is_alike(a.masks.corner, b.masks.corner) &&
         is_alike(a.masks.wide_edge, b.masks.wide_edge) && is_alike(a.masks.wide_face, b.masks.wide_face) &&
         a.masks.wide_borders == b.masks.wide_borders && is_alike(a.creases, b.creases);
}

/// True if two schemes have the same name, options, steps and kinds of masks. Preparation is ignored, since it
/// does not affect limits of levels that need none. Calls no mask.
template <class T>
bool is_alike(const Scheme<T>& a, const Scheme<T>& b) {
  return a.name == b.name && a.chosen == b.chosen && a.period == b.period && a.corners == b.corners &&
         a.knots == b.knots && a.sharpening == b.sharpening && is_alike(a.creases, b.creases) &&
         std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    [](const Step<T>& x, const Step<T>& y) { return is_alike(x, y); });
}

}  // namespace sublimit

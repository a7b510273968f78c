// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of a scheme, built-in or user-defined, before anything is computed with it: it must have steps, the
// masks that their splits need, and masks that return affine combinations of points of their site. All
// functions that take a scheme call it.
//
//   Scheme<double> mine = *AnyScheme("loop");
//   mine.steps[0].masks.edge = {};
//   check_scheme(mine);  // throws InvalidParameter: the step lacks the mask edge
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Presence of each mask of a step, including crease masks.
struct MasksThere {
  bool vertex, edge, face, corner, wide_edge, wide_face, crease_vertex, crease_edge;
};

/// Returns the crease masks of a step: its own, or else those of the scheme.
template <class T>
const CreaseMasks<T>& creases_of(const Scheme<T>& scheme, const Step<T>& step) {
  return step.creases.edge ? step.creases : scheme.creases;
}

/// Throws unless a step has the masks that its split needs.
/// @param list, i  list and number of the step, for the message: "steps", 0
/// @throws InvalidParameter  a missing mask: names scheme, step, mask and what it is needed for
void check_masks(const std::string& scheme, const char* list, size_t i, Split split, const MasksThere& masks);

/// Throws unless the numbers and lists of a scheme are consistent.
/// @throws InvalidParameter  no steps, a period below 1, faces of 1 or 2 corners, preparation for faces of any size
void check_shape(const std::string& scheme, size_t steps, size_t preparation, int period, int corners);

/// Throws unless a scheme is complete. Calls no mask and allocates nothing.
/// @return  the scheme
/// @throws InvalidParameter  see `check_shape` and `check_masks`
template <class T>
const Scheme<T>& check_scheme(const Scheme<T>& scheme) {
  check_shape(scheme.name, scheme.steps.size(), scheme.preparation.size(), scheme.period, scheme.corners);
  const auto check = [&](const char* list, const std::vector<Step<T>>& steps) {
    for (size_t i = 0; i < steps.size(); ++i) {
      const Masks<T>& m = steps[i].masks;
      const CreaseMasks<T>& c = creases_of(scheme, steps[i]);
      const auto there = [](const auto& mask) { return static_cast<bool>(mask); };
      const MasksThere masks{there(m.vertex),    there(m.edge),      there(m.face),   there(m.corner),
                             there(m.wide_edge), there(m.wide_face), there(c.vertex), there(c.edge)};
      check_masks(scheme.name, list, i, steps[i].split, masks);
    }
  };
  check("steps", scheme.steps);
  check("preparation", scheme.preparation);
  return scheme;
}

/// Tolerance of the sum of the weights of a mask, relative to the sum of their absolute values: above the rounding of
/// doubles, below the effect of a wrong weight.
inline constexpr double affine_rounding = 1e-9;
/// True for floating-point number types, such as double; false for rational and algebraic numbers and balls.
template <class T>
inline constexpr bool is_rounded = std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_exact;

/// True if `sum` is the integer `expected`, up to rounding.
/// @param size  sum of the absolute weights
template <class T>
bool is_sum(const T& sum, int expected, const T& size) {
  if constexpr (is_rounded<T>) {
    const T distance = sum < T(expected) ? T(T(expected) - sum) : T(sum - T(expected));
    return distance <= T(affine_rounding) * (size > T(1) ? size : T(1));  // false for NaN
  } else {
    return sum == T(expected);
  }
}

/// Returns a weight as text for messages.
template <class T>
std::string weight_text(const T& x) {
  if constexpr (PlainNumber<T>)
    return format_number(x);
  else if constexpr (requires { x.text(); })
    return x.text();
  else
    return format_number(static_cast<double>(x));
}

/// Throws unless a mask returned points of its own site only.
/// @param mask   name of the mask, as `vertex`
/// @param slots  points of the site
/// @throws InvalidParameter  slots of another site
template <class T>
void check_slots(const std::string& scheme, const char* mask, const Stencil<T>& stencil, Index slots) {
  const auto& terms = stencil.terms();
  if (terms.empty() || (terms.front().first >= 0 && terms.back().first < slots)) return;
  throw InvalidParameter(scheme + "." + mask + " returns points of another site, kept from another call: slot " +
                         std::to_string(terms.front().first < 0 ? terms.front().first : terms.back().first) +
                         ", where the site has " + std::to_string(slots));
}

/// Throws unless what a mask returned is an affine combination of points of its site.
/// @param mask   name of the mask, as `vertex`
/// @param slots  points of the site
/// @throws InvalidParameter  slots of another site, weights that do not add up to 1
template <class T>
void check_mask(const std::string& scheme, const char* mask, const Stencil<T>& stencil, Index slots) {
  check_slots(scheme, mask, stencil, slots);
  T sum(0), size(0);
  for (const auto& [slot, weight] : stencil.terms()) {
    sum += weight;
    if constexpr (is_rounded<T>) size += weight < T(0) ? T(-weight) : weight;
  }
  if (!is_sum(sum, 1, size))
    throw InvalidParameter(scheme + "." + mask + ": the weights add up to " + weight_text(sum) +
                           "; masks are affine, with a sum of 1");
}

/// Checks the stencil of a mask when a matrix is filled: points and weights as `check_mask`; in exact numbers the
/// points only, since proofs report weights that do not add up to 1 in their verdict.
/// @throws InvalidParameter  see `check_mask` and `check_slots`
template <class T>
void check_weights(const std::string& scheme, const char* mask, const Stencil<T>& stencil, Index slots) {
  if constexpr (is_rounded<T>)
    check_mask(scheme, mask, stencil, slots);
  else
    check_slots(scheme, mask, stencil, slots);
}

}  // namespace sublimit

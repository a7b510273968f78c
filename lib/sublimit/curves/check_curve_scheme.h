// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a curve scheme must have before anything is computed with it: check_scheme.h in one dimension less.
#include <string>

#include "sublimit/curves/curve_scheme.h"
#include "sublimit/scheme/check_scheme.h"

namespace sublimit {

/// Throws unless a curve scheme has its masks: `point` and `leg`, or `before` and `after`; a Hermite scheme all four of
/// the primal ones. Calls none of them.
/// @return  the scheme
/// @throws InvalidParameter  naming scheme and mask
template <class T>
const CurveScheme<T>& check_scheme(const CurveScheme<T>& scheme) {
  const CurveMasks<T>& m = scheme.masks;
  const bool dual = m.before || m.after, hermite = m.point_derivative || m.leg_derivative;
  const auto needs = [&](const auto& mask, const char* name, const char* why) {
    if (!mask) throw InvalidParameter(scheme.name + " lacks the mask " + name + ", which " + why);
  };
  if (dual) {
    needs(m.before, "before", "a dual curve scheme needs beside `after`");
    needs(m.after, "after", "a dual curve scheme needs beside `before`");
    if (m.point || m.leg || hermite)
      throw InvalidParameter(scheme.name +
                             " has masks of a dual scheme (before, after) and of a primal one; two of one "
                             "kind are right");
    return scheme;
  }
  needs(m.point, "point", "a curve scheme needs for the children of points");
  needs(m.leg, "leg", "a curve scheme needs for the children of legs");
  if (!hermite) return scheme;
  needs(m.point_derivative, "point_derivative", "a Hermite scheme needs beside `leg_derivative`");
  needs(m.leg_derivative, "leg_derivative", "a Hermite scheme needs beside `point_derivative`");
  return scheme;
}

/// Throws unless what a mask returned is affine over the points, where the weights of derivatives are free.
/// @param component  1: of a derivative, whose weights of points add up to 0
/// @param first, last  slots that exist
/// @throws InvalidParameter  no points, slots that do not exist, weights with another sum
template <class T>
const Stencil<T>& check_mask(const CurveScheme<T>& scheme, int which, int component, const Stencil<T>& stencil,
                             Index first, Index last) {
  const auto name = [&] {
    const std::string child = scheme.masks.dual() ? (which == 0 ? "before" : "after") : which == 0 ? "point" : "leg";
    return scheme.name + "." + child + (component == 1 ? "_derivative" : "");
  };
  const auto& terms = stencil.terms();
  if (terms.empty()) throw InvalidParameter(name() + " returns no points; a mask is a sum of points");
  if (terms.front().first < first || terms.back().first > last)
    throw InvalidParameter(
        name() + " reaches " + std::to_string(terms.front().first < first ? terms.front().first : terms.back().first) +
        " points along the curve, where it ends after " + std::to_string(terms.front().first < first ? first : last));
  const int unknowns = scheme.masks.unknowns();
  T sum(0), size(0);
  for (const auto& [slot, weight] : terms) {
    if (slot % unknowns != 0) continue;  // derivatives
    sum += weight;
    if constexpr (is_rounded<T>) size += weight < T(0) ? T(-weight) : weight;
  }
  if constexpr (is_rounded<T>)  // in exact numbers proofs find it
    if (!is_sum(sum, 1 - component, size))
      throw InvalidParameter(name() + ": the weights of points add up to " + weight_text(sum) + "; " +
                             (component == 0 ? "masks are affine, with a sum of 1" : "those of a derivative to 0"));
  return stencil;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks a curve scheme before anything is computed with it, as scheme/check_scheme.h does for schemes of surfaces. All
// functions that take a curve scheme call it.
//
//   CurveScheme<double> scheme = curve_scheme("chaikin");
//   scheme.masks.after = {};
//   check_scheme(scheme);  // throws InvalidParameter: chaikin lacks the mask after
#include <string>

#include "sublimit/curves/curve_scheme.h"
#include "sublimit/scheme/detail/check_scheme.h"

namespace sublimit {

/// Throws unless a curve scheme has its masks: `point` and `edge`, or `before` and `after`; for a Hermite scheme all
/// four primal masks. Calls none of them.
/// @return  the scheme
/// @throws InvalidParameter  a missing mask, or masks of both kinds: names scheme and mask
template <class T>
const CurveScheme<T>& check_scheme(const CurveScheme<T>& scheme) {
  const CurveMasks<T>& m = scheme.masks;
  const bool dual = m.before || m.after, hermite = m.point_derivative || m.edge_derivative;
  const auto needs = [&](const auto& mask, const char* name, const char* why) {
    if (!mask) throw InvalidParameter(scheme.name + " lacks the mask " + name + ", which " + why);
  };
  if (dual) {
    needs(m.before, "before", "a dual curve scheme needs beside `after`");
    needs(m.after, "after", "a dual curve scheme needs beside `before`");
    if (m.point || m.edge || hermite)
      throw InvalidParameter(scheme.name +
                             " has masks of a dual scheme (before, after) and of a primal one; two of one "
                             "kind are right");
    return scheme;
  }
  needs(m.point, "point", "a curve scheme needs for the children of points");
  needs(m.edge, "edge", "a curve scheme needs for the children of edges");
  if (!hermite) return scheme;
  needs(m.point_derivative, "point_derivative", "a Hermite scheme needs beside `edge_derivative`");
  needs(m.edge_derivative, "edge_derivative", "a Hermite scheme needs beside `point_derivative`");
  return scheme;
}

/// Throws unless a stencil that a mask returned is affine: the weights of points add up to 1, for the mask of a
/// derivative to 0. Weights of derivatives are free. In exact numbers the sum is left to proofs.
/// @param which        0 or 1: the mask `CurveMasks::child(which, component)`, for the message
/// @param component    0 for the mask of a point, 1 for that of a derivative
/// @param first, last  range of slots that exist
/// @return  the stencil
/// @throws InvalidParameter  no points, slots that do not exist, weights with another sum
template <class T>
const Stencil<T>& check_mask(const CurveScheme<T>& scheme, int which, int component, const Stencil<T>& stencil,
                             Index first, Index last) {
  const auto name = [&] {
    const std::string child = scheme.masks.dual() ? (which == 0 ? "before" : "after") : which == 0 ? "point" : "edge";
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

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils, the alphabet of masks: sparse combinations of points, with the arithmetic of the points they stand for.
#include <algorithm>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Sum of weight * point over the points of a site, which are known by their slots (sites.h).
template <class T>
class Stencil {
 public:
  using Term = std::pair<Index, T>;

  Stencil() = default;
  /// The point itself.
  explicit Stencil(Index slot) : terms_{{slot, T(1)}} {}

  /// Slots ascending, each at most once.
  const std::vector<Term>& terms() const { return terms_; }

  Stencil& operator+=(const Stencil& other) {
    for (const Term& term : other.terms_) {
      const auto at = std::lower_bound(terms_.begin(), terms_.end(), term.first,
                                       [](const Term& a, Index slot) { return a.first < slot; });
      if (at != terms_.end() && at->first == term.first) {
        at->second += term.second;
      } else {
        terms_.insert(at, term);
      }
    }
    return *this;
  }
  Stencil& operator*=(const T& factor) {
    for (Term& term : terms_) term.second *= factor;
    return *this;
  }
  Stencil& operator/=(const T& divisor) {
    for (Term& term : terms_) term.second /= divisor;
    return *this;
  }

  friend Stencil operator+(Stencil a, const Stencil& b) { return std::move(a += b); }
  friend Stencil operator-(Stencil a, Stencil b) { return std::move(a += (b *= T(-1))); }
  friend Stencil operator*(const T& factor, Stencil a) { return std::move(a *= factor); }
  friend Stencil operator*(Stencil a, const T& factor) { return std::move(a *= factor); }
  friend Stencil operator/(Stencil a, const T& divisor) { return std::move(a /= divisor); }

 private:
  std::vector<Term> terms_;
};

}  // namespace sublimit

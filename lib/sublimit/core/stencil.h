// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils: sparse linear combinations of points, with the arithmetic of the points that they stand for. Masks are
// written with them.
//
//   const Stencil<double> tail(0), head(1);
//   const Stencil<double> edge_point = (tail + head) / 2;
//   for (const auto& [slot, weight] : edge_point.terms()) std::cout << slot << ": " << weight << "\n";
#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Sum of weight * point over the points of a site, which are numbered by slots (scheme/sites.h). A value: threads may
/// read one together, and write to different ones.
template <class T>
class Stencil {
 public:
  using Term = std::pair<Index, T>;

  Stencil() = default;
  /// Makes the stencil of one point, with weight 1.
  explicit Stencil(Index slot) : terms_{{slot, T(1)}} {}

  /// Returns slots with their weights: slots ascending, each at most once.
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

  // Decimals with exact numbers, which are none of theirs.
  template <class Decimal>
  requires(std::is_floating_point_v<Decimal> && !std::is_convertible_v<Decimal, T>) friend Stencil operator*(
      Decimal factor, const Stencil&) {
    return no_decimals(factor);
  }
  template <class Decimal>
  requires(std::is_floating_point_v<Decimal> && !std::is_convertible_v<Decimal, T>) friend Stencil operator*(
      const Stencil&, Decimal factor) {
    return no_decimals(factor);
  }
  template <class Decimal>
  requires(std::is_floating_point_v<Decimal> && !std::is_convertible_v<Decimal, T>) friend Stencil operator/(
      const Stencil&, Decimal divisor) {
    return no_decimals(divisor);
  }

 private:
  template <class Decimal>
  static Stencil no_decimals(Decimal) {
    static_assert(!std::is_floating_point_v<Decimal>,
                  "a mask of exact numbers takes no decimals: write v.ratio(1, 2) * v.center(), not 0.5 * v.center()");
    return {};
  }

  std::vector<Term> terms_;
};

}  // namespace sublimit

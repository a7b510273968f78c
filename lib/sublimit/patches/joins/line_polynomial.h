// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomials along an edge, 0 <= t <= 1, by their Bernstein coefficients, in any number type. Conditions on
// joins of patches are that such polynomials vanish or have one sign. A polynomial vanishes if all its
// coefficients do, and lies between the least and the greatest of them.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "sublimit/core/detail/bernstein.h"

namespace sublimit {

/// A polynomial along an edge. Sums are written in the larger degree.
template <class T>
class LinePolynomial {
 public:
  /// Makes the empty polynomial, a zero without degree: f + empty is f, f * empty is empty.
  LinePolynomial() : LinePolynomial(std::vector<T>()) {}
  explicit LinePolynomial(std::vector<T> coefficients) : b_(std::move(coefficients)) {}

  /// Returns the degree in which the polynomial is written; -1 for the empty one.
  int degree() const { return b_.degree_u(); }
  const std::vector<T>& coefficients() const { return b_.coefficients(); }
  bool is_zero() const {
    return std::ranges::all_of(coefficients(), [](const T& c) { return c == T(0); });
  }
  /// Returns the derivative; empty for a constant.
  LinePolynomial derivative() const { return degree() > 0 ? LinePolynomial(b_.du()) : LinePolynomial(); }
  /// Returns the polynomial written in a higher degree.
  LinePolynomial elevated(int degree) const {
    if (is_empty() || degree <= this->degree()) return *this;
    return *this * LinePolynomial(std::vector<T>(static_cast<size_t>(degree - this->degree()) + 1, T(1)));
  }
  /// Returns the polynomial over both halves of the edge.
  std::array<LinePolynomial, 2> halves() const {
    auto [first, second] = bernstein_detail::split_line(coefficients(), T(T(1) / T(2)));
    return {LinePolynomial(std::move(first)), LinePolynomial(std::move(second))};
  }

  friend LinePolynomial operator*(const LinePolynomial& f, const LinePolynomial& g) {
    return f.is_empty() || g.is_empty() ? LinePolynomial() : LinePolynomial(f.b_ * g.b_);
  }
  friend LinePolynomial operator*(const T& factor, LinePolynomial f) {
    for (T& c : f.b_.coefficients()) c *= factor;
    return f;
  }
  friend LinePolynomial operator+(const LinePolynomial& f, const LinePolynomial& g) { return sum(f, g, T(1)); }
  friend LinePolynomial operator-(const LinePolynomial& f, const LinePolynomial& g) { return sum(f, g, T(-1)); }

 private:
  explicit LinePolynomial(Bernstein<T> b) : b_(std::move(b)) {}
  bool is_empty() const { return degree() < 0; }
  static LinePolynomial sum(const LinePolynomial& f, const LinePolynomial& g, const T& sign) {
    if (g.is_empty()) return f;
    if (f.is_empty()) return sign * g;
    LinePolynomial result = f.elevated(g.degree());
    const LinePolynomial other = g.elevated(f.degree());
    for (size_t i = 0; i < other.coefficients().size(); ++i)
      result.b_.coefficients()[i] += sign * other.coefficients()[i];
    return result;
  }

  Bernstein<T> b_;  // in u alone
};

/// Sign of a polynomial on 0 < t < 1.
enum class LineSign {
  zero,       ///< it vanishes
  positive,   ///< positive except for isolated zeros
  negative,   ///< likewise
  changing,   ///< both signs occur
  undecided,  ///< coefficients still have both signs after the largest number of halvings
};

namespace line_polynomial_detail {

/// Returns the polynomial divided by t and by 1 - t as often as possible, which changes no sign inside.
template <class T>
LinePolynomial<T> without_zeros_at_ends(const LinePolynomial<T>& f) {
  const std::vector<T>& c = f.coefficients();
  size_t first = 0, last = c.size();
  while (first < last && c[first] == T(0)) ++first;
  while (last > first && c[last - 1] == T(0)) --last;
  if (last - first == c.size()) return f;
  const std::vector<T> of_all = binomials<T>(f.degree()), of_rest = binomials<T>(static_cast<int>(last - first) - 1);
  std::vector<T> rest;
  for (size_t i = first; i < last; ++i) rest.push_back(c[i] * of_all[i] / of_rest[i - first]);
  return LinePolynomial<T>(std::move(rest));
}

/// Finds the signs of a polynomial.
/// @param found  set to true for signs that occur: positive, negative
/// @return  true if the sign is decided on the whole interval
template <class T>
bool find_signs(const LinePolynomial<T>& f, int halvings, bool (&found)[2]) {
  const LinePolynomial<T> inside = without_zeros_at_ends(f);
  const std::vector<T>& c = inside.coefficients();
  if (c.empty()) return true;
  // The ends' coefficients are values, not zero now.
  found[c.front() < T(0)] = found[c.back() < T(0)] = true;
  if (found[0] && found[1]) return true;
  const bool negative = c.front() < T(0);
  if (std::none_of(c.begin(), c.end(), [&](const T& x) { return negative ? T(0) < x : x < T(0); })) return true;
  if (halvings == 0) return false;
  const auto [left, right] = inside.halves();
  return find_signs(left, halvings - 1, found) && find_signs(right, halvings - 1, found);
}

}  // namespace line_polynomial_detail

/// Returns the sign between the ends; zeros at the ends are ignored. With exact numbers only polynomials with a
/// zero of even order inside, at no multiple of 2^-halvings, stay undecided.
template <class T>
LineSign sign_between_ends(const LinePolynomial<T>& f, int halvings = 24) {
  if (f.is_zero()) return LineSign::zero;
  bool found[2] = {false, false};
  const bool decided = line_polynomial_detail::find_signs(f, halvings, found);
  if (found[0] && found[1]) return LineSign::changing;
  if (!decided) return LineSign::undecided;
  return found[1] ? LineSign::negative : LineSign::positive;
}

}  // namespace sublimit

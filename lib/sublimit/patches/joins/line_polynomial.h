// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomials along an edge, 0 <= t <= 1, by their Bernstein coefficients, in any number type. Conditions on
// joins of patches are that such polynomials vanish or have one sign. A polynomial vanishes if all its
// coefficients do, and lies between the least and the greatest of them. Halves are computed by the blossom.
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/patches/detail/blossom.h"

namespace sublimit {

/// Returns the binomial coefficients of degree n.
template <class T>
std::vector<T> binomials(int n) {
  std::vector<T> row{T(1)};
  for (int i = 0; i < n; ++i) row.push_back(row.back() * T(n - i) / T(i + 1));
  return row;
}

/// A polynomial along an edge.
template <class T>
class LinePolynomial {
 public:
  /// Makes the empty polynomial, a zero without degree: f + empty is f, f * empty is empty.
  LinePolynomial() = default;
  explicit LinePolynomial(std::vector<T> coefficients) : c_(std::move(coefficients)) {}

  /// Returns the degree in which the polynomial is written; -1 for the empty one.
  int degree() const { return static_cast<int>(c_.size()) - 1; }
  const std::vector<T>& coefficients() const { return c_; }
  bool is_zero() const {
    return std::all_of(c_.begin(), c_.end(), [](const T& c) { return c == T(0); });
  }
  LinePolynomial derivative() const {
    std::vector<T> d;
    for (int i = 0; i < degree(); ++i) d.push_back(T(degree()) * (c_[i + 1] - c_[i]));
    return LinePolynomial(std::move(d));
  }
  /// Returns the polynomial written in a higher degree.
  LinePolynomial elevated(int degree) const {
    if (c_.empty() || degree <= this->degree()) return *this;
    return *this * LinePolynomial(std::vector<T>(static_cast<size_t>(degree - this->degree()) + 1, T(1)));
  }

  friend LinePolynomial operator*(const LinePolynomial& f, const LinePolynomial& g) {
    if (f.c_.empty() || g.c_.empty()) return {};
    const int n = f.degree(), m = g.degree();
    const std::vector<T> of_f = binomials<T>(n), of_g = binomials<T>(m), of_both = binomials<T>(n + m);
    std::vector<T> c(static_cast<size_t>(n + m) + 1, T(0)), scaled;
    for (int j = 0; j <= m; ++j) scaled.push_back(of_g[j] * g.c_[j]);
    for (int i = 0; i <= n; ++i) {
      const T weight = of_f[i] * f.c_[i];
      for (int j = 0; j <= m; ++j) c[i + j] += weight * scaled[j];
    }
    for (int k = 0; k <= n + m; ++k) c[k] /= of_both[k];
    return LinePolynomial(std::move(c));
  }
  friend LinePolynomial operator*(const T& factor, LinePolynomial f) {
    for (T& c : f.c_) c *= factor;
    return f;
  }
  friend LinePolynomial operator+(const LinePolynomial& f, const LinePolynomial& g) { return sum(f, g, T(1)); }
  friend LinePolynomial operator-(const LinePolynomial& f, const LinePolynomial& g) { return sum(f, g, T(-1)); }

 private:
  static LinePolynomial sum(const LinePolynomial& f, const LinePolynomial& g, const T& sign) {
    if (g.c_.empty()) return f;
    if (f.c_.empty()) return sign * g;
    LinePolynomial result = f.elevated(g.degree());
    const LinePolynomial other = g.elevated(f.degree());
    for (size_t i = 0; i < result.c_.size(); ++i) result.c_[i] += sign * other.c_[i];
    return result;
  }

  std::vector<T> c_;
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

/// Returns the coefficients of both halves: values of the blossom at 0, 1/2 and 1.
template <class T>
std::array<std::vector<T>, 2> halves(const std::vector<T>& c) {
  const int n = static_cast<int>(c.size()) - 1;
  const T half = T(1) / T(2);
  std::vector<T> knots(static_cast<size_t>(n), T(0)), weights(c.size());
  knots.resize(2 * static_cast<size_t>(n), T(1));
  std::array<std::vector<T>, 2> result;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i <= n; ++i) {
      // f(0^(n-i), 1/2^i) and f(1/2^(n-i), 1^i)
      std::vector<BlossomArgument<T>> arguments(static_cast<size_t>(n), BlossomArgument<T>::point(half));
      if (side == 0) std::fill_n(arguments.begin() + i, n - i, BlossomArgument<T>::point(T(0)));
      if (side == 1) std::fill_n(arguments.begin(), i, BlossomArgument<T>::point(T(1)));
      blossom<T>(knots, n - 1, arguments, weights);
      T sum(0);
      for (int j = 0; j <= n; ++j) sum += weights[j] * c[j];
      result[static_cast<size_t>(side)].push_back(sum);
    }
  return result;
}

/// Returns the polynomial divided by t and by 1 - t as often as possible, which changes no sign inside.
template <class T>
std::vector<T> without_zeros_at_ends(const std::vector<T>& c) {
  size_t first = 0, last = c.size();
  while (first < last && c[first] == T(0)) ++first;
  while (last > first && c[last - 1] == T(0)) --last;
  if (last - first == c.size()) return c;
  const std::vector<T> of_all = binomials<T>(static_cast<int>(c.size()) - 1),
                       of_rest = binomials<T>(static_cast<int>(last - first) - 1);
  std::vector<T> rest;
  for (size_t i = first; i < last; ++i) rest.push_back(c[i] * of_all[i] / of_rest[i - first]);
  return rest;
}

/// Finds the signs of a polynomial.
/// @param found  set to true for signs that occur: positive, negative
/// @return  true if the sign is decided on the whole interval
template <class T>
bool find_signs(const std::vector<T>& coefficients, int halvings, bool (&found)[2]) {
  const std::vector<T> c = without_zeros_at_ends(coefficients);
  if (c.empty()) return true;
  // The ends' coefficients are values, not zero now.
  found[c.front() < T(0)] = found[c.back() < T(0)] = true;
  if (found[0] && found[1]) return true;
  const bool negative = c.front() < T(0);
  if (std::none_of(c.begin(), c.end(), [&](const T& x) { return negative ? T(0) < x : x < T(0); })) return true;
  if (halvings == 0) return false;
  const auto [left, right] = halves(c);
  return find_signs(left, halvings - 1, found) && find_signs(right, halvings - 1, found);
}

}  // namespace line_polynomial_detail

/// Returns the sign between the ends; zeros at the ends are ignored. With exact numbers only polynomials with a
/// zero of even order inside, at no multiple of 2^-halvings, stay undecided.
template <class T>
LineSign sign_between_ends(const LinePolynomial<T>& f, int halvings = 24) {
  if (f.is_zero()) return LineSign::zero;
  bool found[2] = {false, false};
  const bool decided = line_polynomial_detail::find_signs(f.coefficients(), halvings, found);
  if (found[0] && found[1]) return LineSign::changing;
  if (!decided) return LineSign::undecided;
  return found[1] ? LineSign::negative : LineSign::positive;
}

}  // namespace sublimit

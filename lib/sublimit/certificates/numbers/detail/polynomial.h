// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact polynomials in one variable over cyclotomic fields: division, common factors, squarefree factors, and
// rigorous enclosures of roots.
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

/// A polynomial; its leading coefficient is not zero.
class Polynomial {
 public:
  Polynomial() = default;  ///< zero
  /// @param coefficients  of 1, x, x^2 ...
  explicit Polynomial(std::vector<Algebraic> coefficients);
  static Polynomial x() { return Polynomial({0, 1}); }

  /// Returns the degree, -1 for the zero polynomial.
  int degree() const { return static_cast<int>(c_.size()) - 1; }
  bool is_zero() const { return c_.empty(); }
  const std::vector<Algebraic>& coefficients() const { return c_; }
  const Algebraic& leading() const { return c_.back(); }
  bool is_rational() const;
  bool is_real() const;

  Polynomial& operator+=(const Polynomial& b);
  Polynomial& operator-=(const Polynomial& b);
  friend Polynomial operator+(Polynomial a, const Polynomial& b) { return std::move(a += b); }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return std::move(a -= b); }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Algebraic& factor, const Polynomial& a);
  friend bool operator==(const Polynomial& a, const Polynomial& b) { return a.c_ == b.c_; }

  Algebraic at(const Algebraic& x) const;
  ComplexBall at(const ComplexBall& x) const;
  Polynomial derivative() const;
  /// Returns the polynomial divided by its leading coefficient.
  Polynomial monic() const;
  /// Returns the polynomial whose roots are the conjugates, or (`negated`) the negatives, of the roots.
  Polynomial conj() const;
  Polynomial negated() const;

  std::string text() const;        ///< "x^2-21/32*x+1/16"
  std::string exact_text() const;  ///< exact texts of the coefficients of 1, x, x^2 ..., separated by "; "
  static Polynomial parse(std::string_view text);

 private:
  void trim();
  std::vector<Algebraic> c_;
};

struct Division {
  Polynomial quotient, remainder;
};
/// Returns quotient and remainder of a by b.
/// @throws AnalysisError  b is zero
Division divide(const Polynomial& a, const Polynomial& b);
/// Returns the greatest common divisor, monic.
Polynomial gcd(Polynomial a, Polynomial b);

struct PolynomialFactor {
  Polynomial factor;  ///< monic
  int multiplicity = 1;
};
/// Returns squarefree, pairwise coprime factors with their multiplicities; rational ones are irreducible.
std::vector<PolynomialFactor> squarefree_factors(const Polynomial& p);

/// Returns disjoint enclosures of all roots of a squarefree polynomial, of absolute radius below 2^-bits. Real
/// roots of real polynomials have imaginary part zero.
std::vector<ComplexBall> isolated_roots(const Polynomial& squarefree, long bits);

/// True if all roots are isolated at a modest precision, so that the polynomial is squarefree. False:
/// undecided.
bool has_isolated_roots(const Polynomial& p);

/// Returns the characteristic polynomial det(x - A), exactly.
Polynomial characteristic_polynomial(const DenseMatrix<Algebraic>& A);

/// Returns the polynomial whose roots are the products of a root of `a` and a root of `b`, both monic.
Polynomial products_of_roots(const Polynomial& a, const Polynomial& b);
/// Returns the polynomial whose roots are the squares of those of `p`.
Polynomial squares_of_roots(const Polynomial& p);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomials in one variable over cyclotomic fields, exactly: division, common factors, squarefree factors, and
// rigorous enclosures of the roots.
#include <vector>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

class Polynomial {
 public:
  Polynomial() = default;  ///< zero
  /// Coefficients of 1, x, x^2 ...
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
  /// The polynomial whose roots are the conjugates, or the negatives, of the roots.
  Polynomial conj() const;
  Polynomial negated() const;

  std::string text() const;        ///< "x^2-21/32*x+1/16"
  std::string exact_text() const;  ///< exact texts of the coefficients of 1, x, x^2 ..., parted by "; "
  static Polynomial parse(std::string_view text);

 private:
  void trim();
  std::vector<Algebraic> c_;
};

struct Division {
  Polynomial quotient, remainder;
};
/// @throws AnalysisError  the divisor is zero
Division divide(const Polynomial& a, const Polynomial& b);
/// Monic.
Polynomial gcd(Polynomial a, Polynomial b);

struct PolynomialFactor {
  Polynomial factor;  ///< monic
  int multiplicity = 1;
};
/// Squarefree, pairwise coprime factors; those over the rationals are irreducible.
std::vector<PolynomialFactor> squarefree_factors(const Polynomial& p);

/// Disjoint enclosures of all roots of a squarefree polynomial, of radius below 2^-bits relative to 1; real roots of
/// real polynomials have imaginary part zero.
std::vector<ComplexBall> isolated_roots(const Polynomial& squarefree, long bits);

/// All roots are found apart at a modest precision, so the polynomial is squarefree. If not, nothing is known.
bool has_isolated_roots(const Polynomial& p);

/// Returns the characteristic polynomial det(x - A), exactly.
Polynomial characteristic_polynomial(const DenseMatrix<Algebraic>& A);

/// Returns the polynomial whose roots are the products of a root of `a` and a root of `b`, both monic.
Polynomial products_of_roots(const Polynomial& a, const Polynomial& b);
/// Returns the polynomial whose roots are the squares of those of `p`.
Polynomial squares_of_roots(const Polynomial& p);

}  // namespace sublimit

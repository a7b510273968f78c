// SPDX-License-Identifier: Apache-2.0
#pragma once
// Roots of polynomials over cyclotomic fields, such as eigenvalues. A root is stored as a polynomial with an
// enclosure that contains no other root of it. Inequalities are decided by enclosures at growing precision,
// equalities exactly by common factors; both terminate.
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/polynomial.h"

namespace sublimit {

/// A root of a polynomial.
class AlgebraicRoot {
 public:
  AlgebraicRoot() : AlgebraicRoot(Algebraic(0)) {}
  /// Makes the root that is an element of the field.
  explicit AlgebraicRoot(Algebraic value);
  /// Returns all roots of a squarefree polynomial. Rational roots, and those of linear factors, have `exact()`.
  static std::vector<AlgebraicRoot> all(const Polynomial& squarefree);
  /// Makes the root that is the only one in an enclosure.
  /// @throws AnalysisError  there is none, or the working precision does not suffice to decide
  static AlgebraicRoot nearest(const Polynomial& squarefree, const ComplexBall& enclosure);

  /// Returns a squarefree monic polynomial with this root, not always the minimal one.
  const Polynomial& polynomial() const { return *polynomial_; }
  /// Returns the value, if the root is known to lie in the field.
  const std::optional<Algebraic>& exact() const { return exact_; }
  /// Returns an enclosure, computed at 128 bits.
  const ComplexBall& enclosure() const { return enclosure_; }
  ComplexBall enclosure(long bits) const;
  /// Returns a ball that contains a real root.
  Ball real_enclosure(long bits = 128) const { return enclosure(bits).re(); }
  bool is_real() const;

  /// True if p vanishes at this root; decided exactly.
  bool is_root_of(const Polynomial& p) const;

  AlgebraicRoot conj() const;
  AlgebraicRoot negated() const;
  AlgebraicRoot squared() const;
  friend AlgebraicRoot operator*(const AlgebraicRoot& a, const AlgebraicRoot& b);

  /// Returns a text: "1/4", "21/64+sqrt(185/4096)", or decimals with the polynomial.
  std::string text() const;

 private:
  std::shared_ptr<const Polynomial> polynomial_;
  ComplexBall enclosure_;
  std::optional<Algebraic> exact_;
};

bool operator==(const AlgebraicRoot& a, const AlgebraicRoot& b);

/// Returns the exact sign of |a| - |b|.
int compare_moduli(const AlgebraicRoot& a, const AlgebraicRoot& b);
/// Returns the exact sign of a - b, for real numbers.
int compare(const AlgebraicRoot& a, const AlgebraicRoot& b);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Symbols of curve masks: Laurent polynomials a(z) = sum a_j z^j with exact coefficients, where new_i = sum_j a_(i-2j)
// old_j. Smoothness comes from factors 1 + z: with k of them, differences of order k follow a scheme too.
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/curves/curve_scheme.h"

namespace sublimit {

/// The symbol of a mask.
struct Symbol {
  int first = 0;                       ///< power of z of the first coefficient
  std::vector<Rational> coefficients;  ///< neither the first nor the last is zero; empty: the zero symbol
  /// New point i lies at (i - shift)/2 where old point j lies at j: 0 for primal schemes, 1/2 for dual ones.
  Rational shift = 0;

  int last() const { return first + static_cast<int>(coefficients.size()) - 1; }
  Rational at(int power) const { return power < first || power > last() ? Rational(0) : coefficients[power - first]; }
};

/// Returns the symbol without zero coefficients at its ends.
Symbol trimmed(Symbol a);

/// Returns the symbol of a scheme's masks away from ends, on one level.
/// @throws AnalysisError  irrational weights, or a Hermite scheme, whose masks are matrices
Symbol symbol(const CurveScheme<Rational>& scheme, int level = 0);

/// Returns a(z)/(1+z), or nothing if 1 + z does not divide a.
std::optional<Symbol> over_one_plus_z(const Symbol& a);

/// Returns the multiplicity of the factor 1 + z of a symbol.
int smoothing_factors(const Symbol& a);

/// Returns a(z)/(1+z)^m, the symbol that takes differences of order m of old points to those of new points.
/// @pre  m <= smoothing_factors(a)
Symbol difference_symbol(Symbol a, int m);

/// True if the integer shifts of the limit function are linearly independent. Points then behave like the
/// limit, so that conditions on differences of points are necessary and not only sufficient. Criterion: a(z)
/// and a(-z) have no common zero except 0, and no cyclotomic polynomial of order 2m, m > 1 odd, divides a.
/// Source: Jia, Wang 1993, "Stability and linear independence associated with wavelet decompositions", Proc.
/// AMS 117.
bool has_independent_shifts(const Symbol& a);

/// Returns a(1) (sign 1) or a(-1) (sign -1).
Rational value_at_one(const Symbol& a, int sign = 1);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cyclotomic polynomials, made once each.
#include <flint/fmpz_poly.h>

namespace sublimit {

/// The N-th cyclotomic polynomial, N > 0. It lives as long as the program; any thread may ask.
const fmpz_poly_struct* cyclotomic_polynomial(long order);

/// p modulo the N-th cyclotomic polynomial, p with integer coefficients.
void reduce_cyclotomic(fmpz_poly_t p, long order);

}  // namespace sublimit

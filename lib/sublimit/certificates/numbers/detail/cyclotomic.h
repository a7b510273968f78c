// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cyclotomic polynomials, each computed once.
#include <flint/fmpz_poly.h>

namespace sublimit {

/// Returns the cyclotomic polynomial of an order > 0. It is valid until the program ends. Thread-safe.
const fmpz_poly_struct* cyclotomic_polynomial(long order);

/// Reduces p, with integer coefficients, modulo the cyclotomic polynomial of an order, in place.
void reduce_cyclotomic(fmpz_poly_t p, long order);

}  // namespace sublimit

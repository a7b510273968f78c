// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/cyclotomic.h"

#include <memory>

#include "sublimit/base/detail/found_once.h"

namespace sublimit {
namespace {

/// zeta^N = 1, or zeta^(N/2) = -1, folds the exponents first: that leaves little to divide.
void fold(fmpz_poly_t p, long order) {
  const bool is_even = order % 2 == 0;
  const long period = is_even ? order / 2 : order, length = fmpz_poly_length(p);
  if (length <= period) return;
  for (long i = period; i < length; ++i) {
    fmpz* const target = p->coeffs + i % period;
    (is_even && i / period % 2 != 0 ? fmpz_sub : fmpz_add)(target, target, p->coeffs + i);
  }
  fmpz_poly_truncate(p, period);
}

}  // namespace

const fmpz_poly_struct* cyclotomic_polynomial(long order) {
  struct Known {
    fmpz_poly_t p;
    explicit Known(long n) {
      fmpz_poly_init(p);
      fmpz_poly_cyclotomic(p, static_cast<ulong>(n));
    }
    ~Known() { fmpz_poly_clear(p); }
  };
  static const FoundByKey<long, std::unique_ptr<const Known>> all;
  return all.get(order, [&] { return std::make_unique<const Known>(order); })->p;
}

void reduce_cyclotomic(fmpz_poly_t p, long order) {
  fold(p, order);
  const fmpz_poly_struct* phi = cyclotomic_polynomial(order);
  if (fmpz_poly_length(p) >= fmpz_poly_length(phi)) fmpz_poly_rem(p, p, phi);
}

}  // namespace sublimit

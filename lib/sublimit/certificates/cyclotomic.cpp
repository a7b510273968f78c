// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/cyclotomic.h"

#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>

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
  static std::shared_mutex mutex;
  static std::map<long, std::unique_ptr<Known>> all;
  {
    const std::shared_lock lock(mutex);
    if (const auto at = all.find(order); at != all.end()) return at->second->p;
  }
  const std::unique_lock lock(mutex);
  std::unique_ptr<Known>& known = all[order];
  if (!known) known = std::make_unique<Known>(order);
  return known->p;
}

void reduce_cyclotomic(fmpz_poly_t p, long order) {
  fold(p, order);
  const fmpz_poly_struct* phi = cyclotomic_polynomial(order);
  if (fmpz_poly_length(p) >= fmpz_poly_length(phi)) fmpz_poly_rem(p, p, phi);
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values of FLINT that are freed at the end of their scope, and stand for themselves in calls of its functions.
#include <flint/fmpq_poly.h>

namespace sublimit {

/// A value of FLINT's type T.
template <class T, void (*init)(T*), void (*clear)(T*)>
class FlintValue {
 public:
  FlintValue() { init(&x_); }
  ~FlintValue() { clear(&x_); }
  FlintValue(const FlintValue&) = delete;
  FlintValue& operator=(const FlintValue&) = delete;
  operator T*() { return &x_; }
  operator const T*() const { return &x_; }
  T* operator->() { return &x_; }

 private:
  T x_;
};

using FlintInteger = FlintValue<fmpz, fmpz_init, fmpz_clear>;
using FlintRatio = FlintValue<fmpq, fmpq_init, fmpq_clear>;
using IntegerPolynomial = FlintValue<fmpz_poly_struct, fmpz_poly_init, fmpz_poly_clear>;
using RationalPolynomial = FlintValue<fmpq_poly_struct, fmpq_poly_init, fmpq_poly_clear>;

}  // namespace sublimit

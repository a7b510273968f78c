// SPDX-License-Identifier: Apache-2.0
#pragma once
// Complex ball arithmetic: complex numbers enclosed in a rectangle, a ball for the real and one for the imaginary part.
//
//   const ComplexBall z = ComplexBall::root_of_unity(1, 7) / ComplexBall(2);
//   const bool inside = certainly_less(abs(z), Ball(1));
//   std::cout << z.text();
#include <acb.h>

#include "sublimit/certificates/numbers/ball.h"

namespace sublimit {

/// A complex number up to a rectangle. A value: threads may read one together, and write to different ones.
class ComplexBall {
 public:
  ComplexBall() { acb_init(z_); }
  ComplexBall(int value) : ComplexBall() { acb_set_si(z_, value); }  // NOLINT: as Ball
  ComplexBall(const Ball& re) : ComplexBall() { acb_set_arb(z_, re.get()); }
  ComplexBall(const Ball& re, const Ball& im) : ComplexBall() { acb_set_arb_arb(z_, re.get(), im.get()); }
  explicit ComplexBall(const acb_t value) : ComplexBall() { acb_set(z_, value); }
  ComplexBall(const ComplexBall& other) : ComplexBall() { acb_set(z_, other.z_); }
  ComplexBall(ComplexBall&& other) noexcept : ComplexBall() { acb_swap(z_, other.z_); }
  ComplexBall& operator=(const ComplexBall& other) {
    acb_set(z_, other.z_);
    return *this;
  }
  ComplexBall& operator=(ComplexBall&& other) noexcept {
    acb_swap(z_, other.z_);
    return *this;
  }
  ~ComplexBall() { acb_clear(z_); }

  /// Returns an enclosure of exp(2 pi i k/n), n > 0.
  static ComplexBall root_of_unity(long k, long n);
  /// Reads a number as `exact_text` writes it.
  /// @throws FormatError  text of another form
  static ComplexBall parse(std::string_view text);

  /// Returns Arb's number, for calls of its functions.
  acb_srcptr get() const { return z_; }
  acb_ptr get() { return z_; }
  /// Returns the real part.
  Ball re() const { return Ball(acb_realref(z_)); }
  /// Returns the imaginary part.
  Ball im() const { return Ball(acb_imagref(z_)); }

  ComplexBall& operator+=(const ComplexBall& b) { return acb_add(z_, z_, b.z_, PrecisionScope::bits()), *this; }
  ComplexBall& operator-=(const ComplexBall& b) { return acb_sub(z_, z_, b.z_, PrecisionScope::bits()), *this; }
  ComplexBall& operator*=(const ComplexBall& b) { return acb_mul(z_, z_, b.z_, PrecisionScope::bits()), *this; }
  ComplexBall& operator/=(const ComplexBall& b) { return acb_div(z_, z_, b.z_, PrecisionScope::bits()), *this; }
  ComplexBall operator-() const {
    ComplexBall r;
    acb_neg(r.z_, z_);
    return r;
  }
  friend ComplexBall operator+(ComplexBall a, const ComplexBall& b) { return std::move(a += b); }
  friend ComplexBall operator-(ComplexBall a, const ComplexBall& b) { return std::move(a -= b); }
  friend ComplexBall operator*(ComplexBall a, const ComplexBall& b) { return std::move(a *= b); }
  friend ComplexBall operator/(ComplexBall a, const ComplexBall& b) { return std::move(a /= b); }

  /// True if both parts have radius 0 and are the same numbers.
  friend bool operator==(const ComplexBall& a, const ComplexBall& b) { return acb_eq(a.z_, b.z_); }

  bool is_finite() const { return acb_is_finite(z_); }
  bool contains_zero() const { return acb_contains_zero(z_); }
  bool contains(const ComplexBall& inner) const { return acb_contains(z_, inner.z_); }
  bool overlaps(const ComplexBall& other) const { return acb_overlaps(z_, other.z_); }

  /// Returns the number in decimal, as "[0.5 +/- 1e-38]", with "+[...]*i" if the imaginary part is not exactly zero.
  std::string text(int digits = 15) const;
  /// Returns `Ball::exact_text` of both parts, separated by " | ".
  std::string exact_text() const;

 private:
  acb_t z_;
};

/// Returns the complex conjugate.
ComplexBall conj(const ComplexBall& z);
/// Returns an enclosure of |z|.
Ball abs(const ComplexBall& z);
/// Returns an enclosure of |z|^2.
Ball norm(const ComplexBall& z);

/// Constants of masks, enclosed at the thread's precision.
template <>
struct Number<ComplexBall> {
  static ComplexBall ratio(int p, int q) { return Number<Ball>::ratio(p, q); }
  static ComplexBall cos_2pi(int k, int n) { return Number<Ball>::cos_2pi(k, n); }
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::ComplexBall> : sublimit::RingTraits<sublimit::ComplexBall> {};

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rational numbers of any length, by FLINT: weights of curve schemes and of regular meshes. A result that
// involves an irrational constant is marked as irrational, without a value: masks of irregular sites may have
// such weights as long as they are not used.
#include <flint/fmpq.h>

#include <compare>
#include <concepts>
#include <string>
#include <utility>

#include "sublimit/certificates/numbers/ball.h"
#include "sublimit/core/scheme_options.h"

namespace sublimit {

/// A rational number, or the mark of an irrational one.
class Rational {
 public:
  Rational() { fmpq_init(x_); }
  template <std::integral I>
  Rational(I value) : Rational() {  // NOLINT: whole numbers are ratios
    if constexpr (std::is_signed_v<I>)
      fmpz_set_si(fmpq_numref(x_), value);
    else
      fmpz_set_ui(fmpq_numref(x_), value);
  }
  Rational(Ratio r) : Rational(r.p, r.q) {}  // NOLINT: so are options
  /// @throws AnalysisError  q = 0
  Rational(long p, long q);
  /// Makes the exact value of a double.
  /// @throws InvalidMesh  it is not finite, as coordinates that overflowed
  explicit Rational(double value);
  explicit Rational(const fmpq_t value) : Rational() { fmpq_set(x_, value); }
  Rational(const Rational& other) : Rational() { *this = other; }
  Rational(Rational&& other) noexcept : Rational() { swap(other); }
  Rational& operator=(const Rational& other) {
    fmpq_set(x_, other.x_);
    is_ratio_ = other.is_ratio_;
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Rational() { fmpq_clear(x_); }
  void swap(Rational& other) noexcept {
    fmpq_swap(x_, other.x_);
    std::swap(is_ratio_, other.is_ratio_);
  }

  const fmpq* get() const { return x_; }
  bool is_zero() const { return is_ratio_ && fmpq_is_zero(x_); }
  /// True unless an irrational number was involved.
  bool is_ratio() const { return is_ratio_; }
  static Rational irrational() {
    Rational r;
    r.is_ratio_ = false;
    return r;
  }
  /// Returns a ball that contains the number, as tight as the thread's precision (PrecisionScope) makes it; the whole
  /// line for an irrational number.
  Ball enclosure() const;
  double value() const { return enclosure().mid(); }
  explicit operator double() const { return value(); }

  Rational& operator+=(const Rational& b) { return fmpq_add(x_, x_, b.x_), with(b); }
  Rational& operator-=(const Rational& b) { return fmpq_sub(x_, x_, b.x_), with(b); }
  Rational& operator*=(const Rational& b) { return fmpq_mul(x_, x_, b.x_), with(b); }
  /// @throws AnalysisError  division by 0
  Rational& operator/=(const Rational& b);
  Rational operator-() const {
    Rational r(*this);
    fmpq_neg(r.x_, r.x_);
    return r;
  }
  friend Rational operator+(Rational a, const Rational& b) { return std::move(a += b); }
  friend Rational operator-(Rational a, const Rational& b) { return std::move(a -= b); }
  friend Rational operator*(Rational a, const Rational& b) { return std::move(a *= b); }
  friend Rational operator/(Rational a, const Rational& b) { return std::move(a /= b); }
  /// An irrational number, whose value is unknown, is unordered with all numbers.
  friend bool operator==(const Rational& a, const Rational& b) {
    return a.is_ratio_ && b.is_ratio_ && fmpq_equal(a.x_, b.x_);
  }
  friend std::partial_ordering operator<=>(const Rational& a, const Rational& b) {
    return a.is_ratio_ && b.is_ratio_ ? std::partial_ordering(fmpq_cmp(a.x_, b.x_) <=> 0)
                                      : std::partial_ordering::unordered;
  }
  friend Rational abs(Rational a) { return fmpq_abs(a.x_, a.x_), a; }
  friend Rational sqrt(const Rational& a);

 private:
  Rational& with(const Rational& b) { return is_ratio_ = is_ratio_ && b.is_ratio_, *this; }

  fmpq_t x_;
  bool is_ratio_ = true;
};

/// Returns the number as text: `-9/64`, or `2`.
std::string to_string(const Rational& r);

template <>
struct Number<Rational> {
  static Rational ratio(int p, int q) { return {p, q}; }
  /// Returns cos(2 pi k/n): 0, +-1/2 or +-1; all others are irrational.
  static Rational cos_2pi(int k, int n);
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::Rational> : sublimit::RingTraits<sublimit::Rational> {};

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Real numbers known up to a radius, rounded outwards by Arb: what these compute encloses what is meant. Comparisons
// say yes only where it is certain. Masks can be instantiated with them; so can everything that is generic in the
// number.
#include <arb.h>

#include <string>
#include <string_view>
#include <utility>

#include "sublimit/certificates/ring_traits.h"
#include "sublimit/core/number.h"

namespace sublimit {

/// Working precision of balls in this thread while it lives, in bits; 128 without one. Other threads keep theirs, so
/// what runs in parallel inside is enclosed too, but perhaps less tightly.
class PrecisionScope {
 public:
  explicit PrecisionScope(long bits) : before_(std::exchange(bits_, bits)) {}
  ~PrecisionScope() { bits_ = before_; }
  PrecisionScope(const PrecisionScope&) = delete;
  PrecisionScope& operator=(const PrecisionScope&) = delete;
  static long bits() { return bits_; }

 private:
  static thread_local long bits_;
  long before_;
};

class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(int value) : Ball(static_cast<long>(value)) {}  // NOLINT: masks write (n - 2)*x
  Ball(long value) : Ball() { arb_set_si(x_, value); }
  explicit Ball(double value) : Ball() { arb_set_d(x_, value); }  ///< exact
  explicit Ball(const arb_t value) : Ball() { arb_set(x_, value); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  /// All numbers of [low, high].
  static Ball hull(const Ball& low, const Ball& high);
  /// From `exact_text`.
  /// @throws FormatError  it is no such text
  static Ball parse(std::string_view text);

  arb_srcptr get() const { return x_; }
  arb_ptr get() { return x_; }

  Ball& operator+=(const Ball& b) { return arb_add(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  Ball& operator-=(const Ball& b) { return arb_sub(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  Ball& operator*=(const Ball& b) { return arb_mul(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  /// Everything, where the divisor contains zero.
  Ball& operator/=(const Ball& b) { return arb_div(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  Ball operator-() const {
    Ball r;
    arb_neg(r.x_, x_);
    return r;
  }
  friend Ball operator+(Ball a, const Ball& b) { return std::move(a += b); }
  friend Ball operator-(Ball a, const Ball& b) { return std::move(a -= b); }
  friend Ball operator*(Ball a, const Ball& b) { return std::move(a *= b); }
  friend Ball operator/(Ball a, const Ball& b) { return std::move(a /= b); }

  /// Certainly equal: both are single numbers, and the same one. So != says "not known to be equal", which is what
  /// keeps all entries of a sparse matrix that may differ from zero.
  friend bool operator==(const Ball& a, const Ball& b) { return arb_eq(a.x_, b.x_); }

  double mid() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// At least the radius.
  double radius() const { return mag_get_d(arb_radref(x_)); }
  /// Nearest floating number to the midpoint: for pictures, never for proofs.
  explicit operator double() const { return mid(); }
  double lower() const;  ///< at most every number of the ball
  double upper() const;
  bool is_finite() const { return arb_is_finite(x_); }
  bool contains_zero() const { return arb_contains_zero(x_); }
  bool contains(const Ball& inner) const { return arb_contains(x_, inner.x_); }
  bool overlaps(const Ball& other) const { return arb_overlaps(x_, other.x_); }

  /// "[0.549988347 +/- 3.1e-39]"
  std::string text(int digits = 15) const;
  /// Midpoint and radius exactly, in hexadecimal; `parse` reads the same ball.
  std::string exact_text() const;

 private:
  arb_t x_;
};

inline bool certainly_less(const Ball& a, const Ball& b) { return arb_lt(a.get(), b.get()); }
inline bool certainly_positive(const Ball& a) { return arb_is_positive(a.get()); }
inline bool certainly_negative(const Ball& a) { return arb_is_negative(a.get()); }
Ball abs(const Ball& x);
/// The greater one of two numbers, one of each ball.
Ball max(const Ball& a, const Ball& b);
Ball sqrt(const Ball& x);
Ball log(const Ball& x);
/// Whatever is in both. Where nothing is, one of the two was wrong.
/// @throws AnalysisError  they do not meet
Ball intersection(const Ball& a, const Ball& b);

template <>
struct Number<Ball> {
  static Ball ratio(int p, int q);
  static Ball cos_2pi(int k, int n);
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::Ball> : sublimit::RingTraits<sublimit::Ball> {};

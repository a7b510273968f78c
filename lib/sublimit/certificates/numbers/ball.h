// SPDX-License-Identifier: Apache-2.0
#pragma once
// Ball arithmetic: real numbers as a midpoint and a radius, rounded outwards by Arb, so that every result encloses the
// exact one. A comparison is true only if it holds for all numbers of the balls. Masks, and everything else that is
// generic in the number type, can be instantiated with balls.
//
//   const PrecisionScope precision(256);  // bits, in this thread
//   const Ball root = sqrt(Ball(2));
//   const bool proved = certainly_less(root, Number<Ball>::ratio(3, 2));
//   std::cout << root.text(30);
#include <arb.h>

#include <string>
#include <string_view>
#include <utility>

#include "sublimit/certificates/numbers/ring_traits.h"
#include "sublimit/core/number.h"

namespace sublimit {

/// Sets the working precision of balls in this thread while the object lives, in bits; it is 128 otherwise. Each thread
/// has its own: work that other threads do meanwhile gives enclosures too, at their precision.
class PrecisionScope {
 public:
  explicit PrecisionScope(long bits) : before_(std::exchange(bits_, bits)) {}
  ~PrecisionScope() { bits_ = before_; }
  PrecisionScope(const PrecisionScope&) = delete;
  PrecisionScope& operator=(const PrecisionScope&) = delete;
  /// Returns the precision of this thread, in bits.
  static long bits() { return bits_; }

 private:
  static thread_local long bits_;
  long before_;
};

/// A real number up to a radius. A value: threads may read one together, and write to different ones.
class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(int value) : Ball(static_cast<long>(value)) {}  // NOLINT: masks write (n - 2)*x
  Ball(long value) : Ball() { arb_set_si(x_, value); }
  /// Makes the exact number, with radius 0.
  explicit Ball(double value) : Ball() { arb_set_d(x_, value); }
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

  /// Returns a ball that contains all numbers of [low, high].
  static Ball hull(const Ball& low, const Ball& high);
  /// Reads a ball as `exact_text` writes it.
  /// @throws FormatError  text of another form
  static Ball parse(std::string_view text);

  /// Returns Arb's number, for calls of its functions.
  arb_srcptr get() const { return x_; }
  arb_ptr get() { return x_; }

  Ball& operator+=(const Ball& b) { return arb_add(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  Ball& operator-=(const Ball& b) { return arb_sub(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  Ball& operator*=(const Ball& b) { return arb_mul(x_, x_, b.x_, PrecisionScope::bits()), *this; }
  /// Divides; the result is the whole line (not finite) if the divisor contains zero.
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

  /// True if both have radius 0 and are the same number. So != means "not known to be equal": a sparse matrix keeps
  /// every entry that may differ from zero.
  friend bool operator==(const Ball& a, const Ball& b) { return arb_eq(a.x_, b.x_); }

  /// Returns the midpoint, rounded to nearest.
  double mid() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// Returns an upper bound of the radius.
  double radius() const { return mag_get_d(arb_radref(x_)); }
  /// Returns the double nearest to the midpoint: for pictures, never for proofs.
  explicit operator double() const { return mid(); }
  /// Returns a lower bound of all numbers of the ball.
  double lower() const;
  /// Returns an upper bound of all numbers of the ball.
  double upper() const;
  bool is_finite() const { return arb_is_finite(x_); }
  bool contains_zero() const { return arb_contains_zero(x_); }
  bool contains(const Ball& inner) const { return arb_contains(x_, inner.x_); }
  bool overlaps(const Ball& other) const { return arb_overlaps(x_, other.x_); }

  /// Returns the ball in decimal, as "[0.549988347 +/- 3.1e-39]".
  std::string text(int digits = 15) const;
  /// Returns midpoint and radius exactly, in hexadecimal; `parse` reads the same ball.
  std::string exact_text() const;

 private:
  arb_t x_;
};

/// True if every number of `a` is less than every number of `b`.
inline bool certainly_less(const Ball& a, const Ball& b) { return arb_lt(a.get(), b.get()); }
/// True if every number of the ball is above 0.
inline bool certainly_positive(const Ball& a) { return arb_is_positive(a.get()); }
/// True if every number of the ball is below 0.
inline bool certainly_negative(const Ball& a) { return arb_is_negative(a.get()); }
/// Returns an enclosure of |x|.
Ball abs(const Ball& x);
/// Returns an enclosure of max(x, y) for all x of `a` and y of `b`.
Ball max(const Ball& a, const Ball& b);
/// Returns an enclosure of the square root; not finite if `x` has negative numbers.
Ball sqrt(const Ball& x);
/// Returns an enclosure of the natural logarithm; not finite if `x` has numbers that are not positive.
Ball log(const Ball& x);
/// Returns the intersection of two enclosures of the same number.
/// @throws AnalysisError  disjoint enclosures: one of them is wrong
Ball intersection(const Ball& a, const Ball& b);

/// Constants of masks, enclosed at the thread's precision.
template <>
struct Number<Ball> {
  static Ball ratio(int p, int q);
  static Ball cos_2pi(int k, int n);
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::Ball> : sublimit::RingTraits<sublimit::Ball> {};

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact ratios of 128-bit integers: masks of curve schemes and of regular meshes are such numbers. What does not fit
// throws. An irrational constant is no ratio, and neither is what is computed from it: masks of irregular sites may
// have such weights as long as nobody uses them.
#include <flint/fmpq.h>

#include <Eigen/Core>

#include <compare>
#include <concepts>
#include <string>

#include "sublimit/certificates/regularity/interval.h"
#include "sublimit/core/number.h"
#include "sublimit/core/scheme_options.h"

namespace sublimit {

class Rational {
 public:
  __extension__ using Integer = __int128;

  Rational() = default;
  template <std::integral I>
  Rational(I value) : p_(value) {}           // NOLINT: whole numbers are ratios
  Rational(Ratio r) : Rational(r.p, r.q) {}  // NOLINT: so are options
  /// @throws AnalysisError  q = 0
  Rational(Integer p, Integer q);
  /// Exactly this double.
  /// @throws AnalysisError  it has no 128-bit numerator and denominator
  explicit Rational(double value);
  /// @throws AnalysisError  it has no 128-bit numerator and denominator
  explicit Rational(const fmpq_t value);

  Integer numerator() const { return p_; }
  Integer denominator() const { return q_; }
  bool is_zero() const { return p_ == 0 && q_ != 0; }
  /// False of what has an irrational number in it.
  bool is_ratio() const { return q_ != 0; }
  static Rational irrational() {
    Rational r;
    r.q_ = 0;
    return r;
  }
  /// Encloses it, without width where it is a double.
  Interval enclosure() const;
  double value() const { return enclosure().middle(); }
  explicit operator double() const { return value(); }

  /// @throws AnalysisError  (all four) the result does not fit, or division by 0
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a) {
    Rational r = a;
    r.p_ = -r.p_;
    return r;
  }
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }
  Rational& operator/=(const Rational& b) { return *this = *this / b; }
  friend bool operator==(const Rational& a, const Rational& b) {
    return a.is_ratio() && a.p_ == b.p_ && a.q_ == b.q_;  // which irrational number one is, is not known
  }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) { return (a - b).p_ <=> Integer{0}; }
  friend Rational abs(const Rational& a) { return a.p_ < 0 ? -a : a; }
  friend Rational sqrt(const Rational& a);

 private:
  Integer p_ = 0, q_ = 1;  ///< no common divisor, q_ > 0; q_ = 0 where it is irrational
};

/// `-9/64`, or `2`.
std::string to_string(const Rational& r);

template <>
struct Number<Rational> {
  static Rational ratio(int p, int q) { return {Rational::Integer{p}, Rational::Integer{q}}; }
  /// Other than 0, +-1/2 and +-1 such cosines are irrational.
  static Rational cos_2pi(int k, int n);
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::Rational> : Eigen::GenericNumTraits<sublimit::Rational> {
  using Real = sublimit::Rational;
  using NonInteger = sublimit::Rational;
  using Nested = sublimit::Rational;
  using Literal = sublimit::Rational;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 50,
    MulCost = 50
  };
  static Real epsilon() { return 0; }
  static Real dummy_precision() { return 0; }
  static int digits10() { return 0; }
};

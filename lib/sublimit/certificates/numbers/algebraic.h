// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact elements of cyclotomic fields Q(zeta_N), zeta_N = exp(2 pi i/N): all that masks are made of (ratios, cosines of
// 2 pi k/n), and all of the Fourier blocks of local matrices. An element is a polynomial in zeta_N of degree below
// phi(N) over the rationals, so equality is equality of coefficients. Where elements of two fields meet, N grows to the
// least common multiple; rationals have N = 1.
//
//   const Algebraic c = Number<Algebraic>::cos_2pi(1, 5);
//   const bool exact = 4 * c * c + 2 * c == Algebraic(1);  // true: the minimal polynomial of cos(2 pi/5)
//   std::cout << (Algebraic::ratio(5, 8) + c / 4).text();  // 5/8+1/4*cos(2pi/5)
#include <flint/fmpq_poly.h>

#include <string>
#include <string_view>
#include <utility>

#include "sublimit/certificates/numbers/complex_ball.h"

namespace sublimit {

/// An exact element of a cyclotomic field. A value: threads may read one together, and write to different ones.
class Algebraic {
 public:
  Algebraic() { fmpq_poly_init(p_); }
  Algebraic(int value) : Algebraic(static_cast<long>(value)) {}  // NOLINT: masks write (n - 2)*x
  Algebraic(long value) : Algebraic() { fmpq_poly_set_si(p_, value); }
  /// Makes the exact fraction that a finite floating-point number is.
  explicit Algebraic(double value);
  explicit Algebraic(const fmpq_t value) : Algebraic() { fmpq_poly_set_fmpq(p_, value); }
  Algebraic(const Algebraic& other) : order_(other.order_) {
    fmpq_poly_init(p_);
    fmpq_poly_set(p_, other.p_);
  }
  Algebraic(Algebraic&& other) noexcept : Algebraic() { swap(other); }
  Algebraic& operator=(const Algebraic& other) {
    fmpq_poly_set(p_, other.p_);
    order_ = other.order_;
    return *this;
  }
  Algebraic& operator=(Algebraic&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Algebraic() { fmpq_poly_clear(p_); }
  void swap(Algebraic& other) noexcept {
    fmpq_poly_swap(p_, other.p_);
    std::swap(order_, other.order_);
  }

  /// Returns p/q, q not 0.
  static Algebraic ratio(long p, long q);
  /// Returns exp(2 pi i k/n), n > 0.
  static Algebraic root_of_unity(long k, long n);
  /// Reads a number as `exact_text` writes it, or a fraction ("9/64").
  /// @throws FormatError  text of another form
  static Algebraic parse(std::string_view text);

  /// Returns N of the field Q(zeta_N): 1 for rationals, never 2 modulo 4. Not always the least N.
  long order() const { return order_; }
  /// Returns the number as a polynomial in zeta_N, of degree below phi(N).
  const fmpq_poly_struct* polynomial() const { return p_; }
  bool is_zero() const { return fmpq_poly_is_zero(p_); }
  bool is_one() const { return fmpq_poly_is_one(p_); }
  bool is_rational() const { return fmpq_poly_length(p_) <= 1; }
  bool is_real() const { return is_rational() || *this == conj(); }
  /// Returns the complex conjugate.
  Algebraic conj() const { return galois(-1); }
  /// Returns the image under the automorphism zeta_N -> zeta_N^a, gcd(a, N) = 1.
  Algebraic galois(long a) const;
  /// Returns 1/x.
  /// @throws AnalysisError  x is zero
  Algebraic inverse() const;

  Algebraic& operator+=(const Algebraic& b);
  Algebraic& operator-=(const Algebraic& b);
  Algebraic& operator*=(const Algebraic& b);
  Algebraic& operator/=(const Algebraic& b) { return *this *= b.inverse(); }
  Algebraic operator-() const {
    Algebraic r(*this);
    fmpq_poly_neg(r.p_, r.p_);
    return r;
  }
  friend Algebraic operator+(Algebraic a, const Algebraic& b) { return std::move(a += b); }
  friend Algebraic operator-(Algebraic a, const Algebraic& b) { return std::move(a -= b); }
  friend Algebraic operator*(Algebraic a, const Algebraic& b) { return std::move(a *= b); }
  friend Algebraic operator/(Algebraic a, const Algebraic& b) { return std::move(a /= b); }
  friend bool operator==(const Algebraic& a, const Algebraic& b);

  /// Returns a rectangle that contains the number, as tight as the thread's precision (PrecisionScope) makes it.
  ComplexBall enclosure() const;
  /// Returns a ball that contains a real number.
  /// @throws AnalysisError  the number is not real
  Ball real_enclosure() const;
  /// Returns the real part, rounded: for pictures, never for proofs.
  explicit operator double() const { return enclosure().re().mid(); }

  /// Returns the number in readable form: "9/64", "5/8+1/4*cos(2pi/5)" where that is short, else the polynomial in
  /// z = exp(2 pi i/N), "1/2+z^3, z = exp(2pi i/7)".
  std::string text() const;
  /// Returns the number as `parse` reads it: "9/64", or N and the coefficients of 1, zeta_N, zeta_N^2, ..., as in
  /// "[5] 5/8 0 -1/8 -1/8".
  std::string exact_text() const;

 private:
  friend std::pair<Algebraic, Algebraic> in_one_field(const Algebraic& a, const Algebraic& b);
  void lift(long order);
  void reduce();

  fmpq_poly_t p_;
  long order_ = 1;
};

/// Returns the complex conjugate.
inline Algebraic conj(const Algebraic& x) { return x.conj(); }

/// Exact constants of masks.
template <>
struct Number<Algebraic> {
  static Algebraic ratio(int p, int q) { return Algebraic::ratio(p, q); }
  static Algebraic cos_2pi(int k, int n) {
    return (Algebraic::root_of_unity(k, n) + Algebraic::root_of_unity(-k, n)) * Algebraic::ratio(1, 2);
  }
};

}  // namespace sublimit

template <>
struct Eigen::NumTraits<sublimit::Algebraic> : sublimit::RingTraits<sublimit::Algebraic> {};

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomials over a square or a triangle by their Bernstein coefficients, in any number type. Exact numbers
// prove identities. Balls prove signs, since a polynomial lies between its least and its greatest coefficient.
// Polynomials of one variable have degree 0 in v.
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include "sublimit/core/detail/binomial.h"
#include "sublimit/core/number.h"

namespace sublimit {

/// Domain of a polynomial.
enum class PieceShape {
  square,    ///< 0 <= u, v <= 1; degrees in u and in v
  triangle,  ///< 0 <= u, v, u + v <= 1; one total degree
};

/// A place inside a piece. In the triangle 1 - u - v is the third coordinate.
template <class T>
struct PiecePlace {
  T u, v;
};

/// Returns the number of coefficient b_ij, i for u and j for v, in order of i, then j. In the triangle i + j <= degree.
/// @param degree_v  degree in v; the total degree of a triangle
constexpr int coefficient_number(PieceShape shape, int degree_v, int i, int j) {
  return shape == PieceShape::square ? i * (degree_v + 1) + j : i * (degree_v + 1) - i * (i - 1) / 2 + j;
}

/// A polynomial in Bernstein form.
/// @tparam C  type of coefficients: T, or vectors of fixed size of T as in Eigen
template <class T, class C = T>
class Bernstein {
 public:
  /// Makes the zero polynomial; without coefficients if degree_u is -1.
  Bernstein(PieceShape shape, int degree_u, int degree_v)
      : shape_(shape), du_(degree_u), dv_(degree_v), c_(static_cast<size_t>(count(shape, du_, dv_)), zero()) {}
  /// Makes a polynomial in u alone.
  explicit Bernstein(std::vector<C> coefficients)
      : shape_(PieceShape::square),
        du_(static_cast<int>(coefficients.size()) - 1),
        dv_(0),
        c_(std::move(coefficients)) {}

  static int count(PieceShape shape, int du, int dv) {
    return shape == PieceShape::square ? (du + 1) * (dv + 1) : (du + 1) * (du + 2) / 2;
  }

  PieceShape shape() const { return shape_; }
  int degree_u() const { return du_; }
  int degree_v() const { return dv_; }
  std::vector<C>& coefficients() { return c_; }
  const std::vector<C>& coefficients() const { return c_; }
  /// Returns the largest j of the coefficients b_ij.
  int last(int i) const { return shape_ == PieceShape::square ? dv_ : du_ - i; }
  size_t index(int i, int j) const { return static_cast<size_t>(coefficient_number(shape_, dv_, i, j)); }
  C& operator()(int i, int j) { return c_[index(i, j)]; }
  const C& operator()(int i, int j) const { return c_[index(i, j)]; }

  /// Returns the derivative by u (v); zero of degree 0 if the polynomial has degree 0 in this direction.
  Bernstein du() const { return derivative(1, 0); }
  Bernstein dv() const { return derivative(0, 1); }

  /// Returns the polynomial over a smaller piece: the square [p0.u, p1.u] x [p0.v, p2.v], or the triangle p0 (u = v =
  /// 0), p1 (u = 1), p2 (v = 1). Coefficients are
  /// computed as values of the blossom at the corners.
  Bernstein restricted(const PiecePlace<T>& p0, const PiecePlace<T>& p1, const PiecePlace<T>& p2) const;
  C at(const PiecePlace<T>& p) const;

  /// Returns the quarters of the piece.
  std::array<Bernstein, 4> quarters() const;

  Bernstein& operator-=(const Bernstein& b) {
    for (size_t k = 0; k < c_.size(); ++k) c_[k] -= b.c_[k];
    return *this;
  }

 private:
  static C zero() {
    if constexpr (std::is_same_v<T, C>)
      return C();
    else
      return C::Zero();
  }
  Bernstein derivative(int iu, int iv) const;

  PieceShape shape_;
  int du_, dv_;
  std::vector<C> c_;
};

namespace bernstein_detail {

/// Calls visit(b_ij, weight) for all coefficients; B_ij = weight * u^i v^j * (powers of the other coordinates).
template <class T, class Visit>
void for_each_weight(Bernstein<T>& f, const Visit& visit) {
  const std::vector<T> of_u = binomials<T>(f.degree_u());
  std::vector<T> of_v = binomials<T>(f.degree_v());
  for (int i = 0; i <= f.degree_u(); ++i) {
    if (f.shape() == PieceShape::triangle) of_v = binomials<T>(f.last(i));
    for (int j = 0; j <= f.last(i); ++j) visit(f(i, j), T(of_u[static_cast<size_t>(i)] * of_v[static_cast<size_t>(j)]));
  }
}

/// One step of de Casteljau on n values spaced `stride` apart, towards t.
template <class T, class C>
void step(C* b, int n, int stride, const T& t) {
  const T s = T(1) - t;
  for (int k = 0; k + 1 < n; ++k) b[k * stride] = s * b[k * stride] + t * b[(k + 1) * stride];
}

/// Returns the coefficients of a line over [0, t] and over [t, 1].
template <class T, class C>
std::array<std::vector<C>, 2> split_line(std::vector<C> c, const T& t) {
  std::vector<C> first;
  for (int n = static_cast<int>(c.size()); n > 0; --n) {
    first.push_back(c[0]);
    step(c.data(), n, 1, t);
  }
  return {std::move(first), std::move(c)};
}

/// Replaces n Bernstein coefficients over [0, 1], spaced `stride` apart, by those over [a, b].
template <class T, class C>
void restrict_line(C* c, int n, int stride, const T& a, const T& b) {
  std::vector<C> result;
  for (int i = 0; i < n; ++i) {
    std::vector<C> work;
    for (int k = 0; k < n; ++k) work.push_back(c[k * stride]);
    for (int r = 0; r + 1 < n; ++r) step(work.data(), n - r, 1, r < i ? b : a);
    result.push_back(work[0]);
  }
  for (int k = 0; k < n; ++k) c[k * stride] = result[static_cast<size_t>(k)];
}

}  // namespace bernstein_detail

template <class T, class C>
Bernstein<T, C> Bernstein<T, C>::derivative(int iu, int iv) const {
  const bool square = shape_ == PieceShape::square;
  const int degree = square ? (iu ? du_ : dv_) : du_;
  if (degree == 0) return Bernstein(shape_, du_, dv_);
  Bernstein r(shape_, du_ - (square ? iu : 1), dv_ - (square ? iv : 1));
  for (int i = 0; i <= r.du_; ++i)
    for (int j = 0; j <= r.last(i); ++j) r(i, j) = T(degree) * ((*this)(i + iu, j + iv) - (*this)(i, j));
  return r;
}

template <class T, class C>
Bernstein<T, C> Bernstein<T, C>::restricted(const PiecePlace<T>& p0, const PiecePlace<T>& p1,
                                            const PiecePlace<T>& p2) const {
  Bernstein r = *this;
  if (shape_ == PieceShape::square) {
    for (int j = 0; j <= dv_; ++j) bernstein_detail::restrict_line(&r.c_[r.index(0, j)], du_ + 1, dv_ + 1, p0.u, p1.u);
    for (int i = 0; i <= du_; ++i) bernstein_detail::restrict_line(&r.c_[r.index(i, 0)], dv_ + 1, 1, p0.v, p2.v);
    return r;
  }
  for (int i = 0; i <= du_; ++i)
    for (int j = 0; j <= du_ - i; ++j) {
      Bernstein work = *this;
      for (int step = 0; step < du_; ++step) {
        const PiecePlace<T>& p = step < i ? p1 : step < i + j ? p2 : p0;
        const T w = T(1) - p.u - p.v;
        Bernstein less(shape_, work.du_ - 1, work.du_ - 1);
        for (int a = 0; a <= less.du_; ++a)
          for (int b = 0; b <= less.du_ - a; ++b)
            less(a, b) = w * work(a, b) + p.u * work(a + 1, b) + p.v * work(a, b + 1);
        work = std::move(less);
      }
      r(i, j) = work.c_[0];
    }
  return r;
}

template <class T, class C>
C Bernstein<T, C>::at(const PiecePlace<T>& p) const {
  Bernstein b = *this;
  if (shape_ == PieceShape::square) {
    for (int i = 0; i <= du_; ++i)
      for (int n = dv_ + 1; n > 1; --n) bernstein_detail::step(&b.c_[b.index(i, 0)], n, 1, p.v);
    for (int n = du_ + 1; n > 1; --n) bernstein_detail::step(b.c_.data(), n, dv_ + 1, p.u);
    return b.c_[0];
  }
  const T w = T(1) - p.u - p.v;
  for (int d = du_; d > 0; --d)
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d - i; ++j) b(i, j) = w * b(i, j) + p.u * b(i + 1, j) + p.v * b(i, j + 1);
  return b.c_[0];
}

template <class T, class C>
std::array<Bernstein<T, C>, 4> Bernstein<T, C>::quarters() const {
  const T o(0), h = Number<T>::ratio(1, 2), l(1);
  if (shape_ == PieceShape::square)
    return {restricted({o, o}, {h, o}, {o, h}), restricted({h, o}, {l, o}, {h, h}), restricted({o, h}, {h, h}, {o, l}),
            restricted({h, h}, {l, h}, {h, l})};
  return {restricted({o, o}, {h, o}, {o, h}), restricted({h, o}, {l, o}, {h, h}), restricted({o, h}, {h, h}, {o, l}),
          restricted({h, h}, {o, h}, {h, o})};
}

/// Returns the product, whose degree is the sum of the degrees.
template <class T>
Bernstein<T> operator*(const Bernstein<T>& f, const Bernstein<T>& g) {
  using bernstein_detail::for_each_weight;
  Bernstein<T> r(f.shape(), f.degree_u() + g.degree_u(), f.degree_v() + g.degree_v()), wf = f, wg = g;
  for (Bernstein<T>* p : {&wf, &wg}) for_each_weight(*p, [](T& c, const T& weight) { c *= weight; });
  for (int i = 0; i <= f.degree_u(); ++i)
    for (int j = 0; j <= f.last(i); ++j)
      for (int k = 0; k <= g.degree_u(); ++k)
        for (int l = 0; l <= g.last(k); ++l) r(i + k, j + l) += wf(i, j) * wg(k, l);
  for_each_weight(r, [](T& c, const T& weight) { c /= weight; });
  return r;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers with their first and second derivatives by two variables u and v (automatic differentiation). A
// formula evaluated on jets of its variables gives its exact derivatives, without a second formula that could
// disagree.
// Source: Griewank, Walther, "Evaluating Derivatives", 2nd edition, SIAM 2008 (forward mode).
#include <Eigen/Core>

#include <cmath>
#include <type_traits>

namespace sublimit {

/// A number with derivatives.
template <class T>
struct Jet {
  T value = T(0), u = T(0), v = T(0), uu = T(0), uv = T(0), vv = T(0);

  Jet() = default;
  Jet(const T& constant) : value(constant) {}  // NOLINT: constants are jets
  Jet(int constant) requires(!std::is_same_v<T, int>) : value(T(constant)) {}
  Jet(const T& value, const T& u, const T& v, const T& uu = T(0), const T& uv = T(0), const T& vv = T(0))
      : value(value), u(u), v(v), uu(uu), uv(uv), vv(vv) {}

  /// Returns f of this number, given value and derivatives of f there.
  Jet under(const T& f, const T& df, const T& ddf) const {
    return {f, df * u, df * v, df * uu + ddf * u * u, df * uv + ddf * u * v, df * vv + ddf * v * v};
  }

  Jet operator-() const { return {-value, -u, -v, -uu, -uv, -vv}; }
  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.u + b.u, a.v + b.v, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv};
  }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            a.u * b.value + a.value * b.u,
            a.v * b.value + a.value * b.v,
            a.uu * b.value + T(2) * a.u * b.u + a.value * b.uu,
            a.uv * b.value + a.u * b.v + a.v * b.u + a.value * b.uv,
            a.vv * b.value + T(2) * a.v * b.v + a.value * b.vv};
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const T inverse = T(1) / b.value, squared = inverse * inverse;
    return a * b.under(inverse, -squared, T(2) * squared * inverse);
  }
  friend Jet sqrt(const Jet& a) {
    using std::sqrt;
    const T root = sqrt(a.value), first = T(1) / (T(2) * root);
    return a.under(root, first, -first / (T(2) * a.value));
  }
  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  Jet& operator/=(const Jet& b) { return *this = *this / b; }
};

/// Returns a number without its derivatives.
template <class T>
const T& value_of(const T& x) {
  return x;
}
template <class T>
const T& value_of(const Jet<T>& x) {
  return x.value;
}

}  // namespace sublimit

namespace Eigen {

template <class T>
struct NumTraits<sublimit::Jet<T>> : GenericNumTraits<sublimit::Jet<T>> {
  using Real = sublimit::Jet<T>;
  using NonInteger = sublimit::Jet<T>;
  using Nested = sublimit::Jet<T>;
  using Literal = sublimit::Jet<T>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 6,
    AddCost = 6,
    MulCost = 24
  };
};

}  // namespace Eigen

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers with their first and second derivatives by x, y and z: forward automatic differentiation.
//
//   const Triple<FieldJet> x = variables({1, 2, 3});
//   const FieldJet distance = sqrt(squared_norm(x)) - 1;
//   distance.value, distance.gradient, distance.hessian;
//
// Eigen's AutoDiffScalar nested in itself would do the same with twice the numbers, does not mix with doubles in most
// expressions, and cannot say that a derivative does not exist. This needs two rules, of products and of functions of
// one variable.
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace sublimit {

/// The value of a function at a point, with its derivatives there. Plain data.
struct FieldJet {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  /// Order of the highest derivatives that exist, 0 to 2; higher ones are one-sided, or zero.
  int order = 2;

  FieldJet() = default;
  FieldJet(double constant) : value(constant) {}  // NOLINT: numbers are jets
};

/// Returns f(a) by the chain rule.
/// @param f, df, ddf  value and derivatives of f at a.value
inline FieldJet chained(const FieldJet& a, double f, double df, double ddf) {
  FieldJet result(f);
  result.gradient = df * a.gradient;
  result.hessian = df * a.hessian + ddf * (a.gradient * a.gradient.transpose());
  result.order = a.order;
  return result;
}

inline FieldJet operator+(const FieldJet& a, const FieldJet& b) {
  FieldJet result(a.value + b.value);
  result.gradient = a.gradient + b.gradient;
  result.hessian = a.hessian + b.hessian;
  result.order = std::min(a.order, b.order);
  return result;
}
inline FieldJet operator*(const FieldJet& a, const FieldJet& b) {
  FieldJet result(a.value * b.value);
  result.gradient = a.value * b.gradient + b.value * a.gradient;
  result.hessian = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                   b.gradient * a.gradient.transpose();
  result.order = std::min(a.order, b.order);
  return result;
}
inline FieldJet operator-(const FieldJet& a) { return chained(a, -a.value, -1, 0); }
inline FieldJet operator-(const FieldJet& a, const FieldJet& b) { return a + -b; }
inline FieldJet operator/(const FieldJet& a, const FieldJet& b) {
  const double r = 1 / b.value;
  return a * chained(b, r, -r * r, 2 * r * r * r);
}
inline FieldJet exp(const FieldJet& a) {
  const double e = std::exp(a.value);
  return chained(a, e, e, e);
}
inline FieldJet sin(const FieldJet& a) { return chained(a, std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
inline FieldJet cos(const FieldJet& a) { return chained(a, std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
/// Returns the square root. At 0 it has no derivatives, whatever `a` is.
inline FieldJet sqrt(const FieldJet& a) {
  const double root = std::sqrt(a.value);
  if (!(root > 0)) {
    FieldJet none(root);
    none.order = 0;
    return none;
  }
  return chained(a, root, .5 / root, -.25 / (root * a.value));
}
/// Returns a^n, n >= 0.
inline FieldJet power(const FieldJet& a, int n) {
  const double x = a.value;
  return chained(a, std::pow(x, n), n < 1 ? 0 : n * std::pow(x, n - 1), n < 2 ? 0 : n * (n - 1) * std::pow(x, n - 2));
}

/// Returns the smaller one of two values. If they are equal, only derivatives that both share exist.
inline FieldJet lesser(const FieldJet& a, const FieldJet& b) {
  if (a.value != b.value) return a.value < b.value ? a : b;
  FieldJet result = a;
  result.order = std::min(a.order, b.order);
  if (a.gradient != b.gradient) result.order = 0;
  if (a.hessian != b.hessian) result.order = std::min(result.order, 1);
  return result;
}
/// Returns the greater one of two values, as `lesser` does.
inline FieldJet greater(const FieldJet& a, const FieldJet& b) { return -lesser(-a, -b); }
/// Returns |a|.
inline FieldJet magnitude(const FieldJet& a) { return greater(a, -a); }

// Overloads for plain numbers, so that a formula is written once.
inline double value_of(double a) { return a; }
inline double value_of(const FieldJet& a) { return a.value; }
inline double power(double a, int n) { return std::pow(a, n); }
inline double lesser(double a, double b) { return b < a ? b : a; }
inline double greater(double a, double b) { return b > a ? b : a; }
inline double magnitude(double a) { return std::abs(a); }
/// Returns `a` with derivatives above `order` marked as not existing.
inline double up_to(double a, int) { return a; }
inline FieldJet up_to(FieldJet a, int order) {
  a.order = std::min(a.order, order);
  return a;
}

/// Coordinates of a point, as numbers or as jets: the argument of formulas.
template <class T>
using Triple = std::array<T, 3>;

/// Returns the coordinates of a point as numbers.
inline Triple<double> plain_place(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }
/// Returns x, y and z as jets: each has derivative 1 by itself.
inline Triple<FieldJet> variables(const Eigen::Vector3d& x) {
  Triple<FieldJet> all{x[0], x[1], x[2]};
  for (int i = 0; i < 3; ++i) all[size_t(i)].gradient[i] = 1;
  return all;
}

/// Returns x - p.
template <class T>
Triple<T> minus(const Triple<T>& x, const Eigen::Vector3d& p) {
  return {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
}
/// Returns the dot product of x and d.
template <class T>
T dot(const Triple<T>& x, const Eigen::Vector3d& d) {
  return x[0] * d[0] + x[1] * d[1] + x[2] * d[2];
}
/// Returns |x|^2.
template <class T>
T squared_norm(const Triple<T>& x) {
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

}  // namespace sublimit

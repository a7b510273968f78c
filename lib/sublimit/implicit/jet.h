// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers that carry their first and second derivatives by x, y and z: forward automatic differentiation.
//
// Eigen's AutoDiffScalar nested in itself would do the same with twice the numbers, does not mix with doubles in most
// expressions, and cannot say that a derivative does not exist. This needs two rules, of products and of functions of
// one variable.
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace sublimit {

struct FieldJet {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  /// Order of the highest derivatives that exist here, 0 to 2; those above are one side's, or zero.
  int order = 2;

  FieldJet() = default;
  FieldJet(double constant) : value(constant) {}  // NOLINT: numbers are jets
};

/// A function of one variable, by its value and derivatives at a.value.
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
/// Without derivatives at 0, whatever is below the root.
inline FieldJet sqrt(const FieldJet& a) {
  const double root = std::sqrt(a.value);
  if (!(root > 0)) {
    FieldJet none(root);
    none.order = 0;
    return none;
  }
  return chained(a, root, .5 / root, -.25 / (root * a.value));
}
/// a^n, n >= 0.
inline FieldJet power(const FieldJet& a, int n) {
  const double x = a.value;
  return chained(a, std::pow(x, n), n < 1 ? 0 : n * std::pow(x, n - 1), n < 2 ? 0 : n * (n - 1) * std::pow(x, n - 2));
}

/// The smaller one. Where both are equal, only derivatives exist that they share.
inline FieldJet lesser(const FieldJet& a, const FieldJet& b) {
  if (a.value != b.value) return a.value < b.value ? a : b;
  FieldJet result = a;
  result.order = std::min(a.order, b.order);
  if (a.gradient != b.gradient) result.order = 0;
  if (a.hessian != b.hessian) result.order = std::min(result.order, 1);
  return result;
}
inline FieldJet greater(const FieldJet& a, const FieldJet& b) { return -lesser(-a, -b); }
inline FieldJet magnitude(const FieldJet& a) { return greater(a, -a); }

// The same of plain numbers, so that a formula is written once.
inline double value_of(double a) { return a; }
inline double value_of(const FieldJet& a) { return a.value; }
inline double power(double a, int n) { return std::pow(a, n); }
inline double lesser(double a, double b) { return b < a ? b : a; }
inline double greater(double a, double b) { return b > a ? b : a; }
inline double magnitude(double a) { return std::abs(a); }
/// Derivatives above `order` do not exist.
inline double up_to(double a, int) { return a; }
inline FieldJet up_to(FieldJet a, int order) {
  a.order = std::min(a.order, order);
  return a;
}

/// Three numbers, or three jets: a place as formulas see it.
template <class T>
using Triple = std::array<T, 3>;

inline Triple<double> plain_place(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }
/// x, y and z themselves, as jets.
inline Triple<FieldJet> variables(const Eigen::Vector3d& x) {
  Triple<FieldJet> all{x[0], x[1], x[2]};
  for (int i = 0; i < 3; ++i) all[size_t(i)].gradient[i] = 1;
  return all;
}

template <class T>
Triple<T> minus(const Triple<T>& x, const Eigen::Vector3d& p) {
  return {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
}
template <class T>
T dot(const Triple<T>& x, const Eigen::Vector3d& d) {
  return x[0] * d[0] + x[1] * d[1] + x[2] * d[2];
}
template <class T>
T squared_norm(const Triple<T>& x) {
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

}  // namespace sublimit

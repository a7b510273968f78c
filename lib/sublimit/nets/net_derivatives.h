// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives of a polynomial part in Bernstein form: the convex hulls of their coefficients bound them, de
// Casteljau's algorithm evaluates them.
#include <array>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// Bernstein nets of a polynomial and its derivatives.
class NetDerivatives {
 public:
  /// @param net    Bernstein coefficients, a row each; 3 columns, or 4 for rational parts
  /// @param order  highest order of derivatives, 1 or 2
  NetDerivatives(const PolynomialBasis& basis, Points net, int order);

  /// Returns the coefficients of the derivative of order du in u and dv in v; no rows if it is zero.
  const Points& net(int du, int dv) const { return nets_[number(du, dv)]; }

  /// Value and derivatives at a place. Second derivatives beyond `order` and a missing fourth column are zero.
  struct Jet {
    Eigen::Vector4d x, u, v, uu, uv, vv;
  };
  /// Returns value and derivatives at (u, v).
  Jet at(double u, double v) const;

 private:
  static size_t number(int du, int dv) { return size_t((du + dv) * (du + dv + 1) / 2 + dv); }  // x, u, v, uu, uv, vv
  Eigen::Vector4d value(int du, int dv, double u, double v) const;

  int degree_;
  bool total_;
  std::array<Points, 6> nets_;
};

}  // namespace sublimit

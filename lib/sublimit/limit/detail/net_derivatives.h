// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives of a polynomial part, again by Bernstein coefficients: their hulls bound them, de Casteljau's steps
// evaluate them.
#include <array>

#include "sublimit/limit/detail/piece_parts.h"

namespace sublimit {

class NetDerivatives {
 public:
  /// @param net    x 3, or x 4
  /// @param order  of the derivatives wanted, 1 or 2
  NetDerivatives(const PolynomialBasis& basis, Points net, int order);

  /// Coefficients of the derivative, du times along u and dv times along v; no rows where it is zero.
  const Points& net(int du, int dv) const { return nets_[number(du, dv)]; }

  struct Jet {
    Eigen::Vector4d x, u, v, uu, uv, vv;  ///< second ones are zero if they were not wanted; so is a column that is not
  };
  Jet at(double u, double v) const;

 private:
  static size_t number(int du, int dv) { return size_t((du + dv) * (du + dv + 1) / 2 + dv); }  // x, u, v, uu, uv, vv
  Eigen::Vector4d value(int du, int dv, double u, double v) const;

  int degree_;
  bool total_;
  std::array<Points, 6> nets_;
};

}  // namespace sublimit

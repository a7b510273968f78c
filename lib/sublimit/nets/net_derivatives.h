// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives of a polynomial part in Bernstein form: the convex hulls of their coefficients bound them, de
// Casteljau's algorithm evaluates them.
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// Bernstein nets of a polynomial and its derivatives.
class NetDerivatives {
 public:
  /// @param net    Bernstein coefficients, a row each; 3 columns, or 4 for rational parts
  /// @param order  highest order of derivatives, 1 or 2
  NetDerivatives(const PolynomialBasis& basis, const Points& net, int order);

  /// Coefficients, a row each; the fourth column is zero unless the part is rational.
  using Coefficients = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>>;
  /// Returns the coefficients of the derivative of order du in u and dv in v, at most `order` in all.
  Coefficients net(int du, int dv) const;

  /// Value and derivatives at a place. Second derivatives beyond `order` and a missing fourth column are zero.
  struct Jet {
    Eigen::Vector4d x, u, v, uu, uv, vv;
  };
  /// Returns value and derivatives at (u, v).
  Jet at(double u, double v) const;

 private:
  using Net = Bernstein<double, Eigen::Vector4d>;
  std::vector<Net> nets_;  // x, u, v, uu, uv, vv
};

}  // namespace sublimit

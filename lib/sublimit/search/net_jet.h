// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values and derivatives of a polynomial part by its Bernstein coefficients.
#include "sublimit/limit/piece_parts.h"

namespace sublimit {

struct NetJet {
  Eigen::Vector3d x, u, v, uu, uv, vv;
};
NetJet net_jet(const PolynomialBasis& basis, const Points& net, double u, double v);

}  // namespace sublimit

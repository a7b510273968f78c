// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/net_derivatives.h"

namespace sublimit {

NetDerivatives::NetDerivatives(const PolynomialBasis& basis, const Points& net, int order) {
  nets_.reserve(6);
  Net& x = nets_.emplace_back(net_shape(basis), basis.degree(), basis.degree());
  for (Eigen::Index row = 0; row < net.rows(); ++row) x.coefficients()[size_t(row)].head(net.cols()) = net.row(row);
  nets_.push_back(x.du());
  nets_.push_back(x.dv());
  if (order < 2) return;
  const Net &u = nets_[1], &v = nets_[2];
  nets_.push_back(u.du());
  nets_.push_back(u.dv());
  nets_.push_back(v.dv());
}

NetDerivatives::Coefficients NetDerivatives::net(int du, int dv) const {
  const std::vector<Eigen::Vector4d>& c = nets_[size_t((du + dv) * (du + dv + 1) / 2 + dv)].coefficients();
  return {c.front().data(), Eigen::Index(c.size()), 4};
}

NetDerivatives::Jet NetDerivatives::at(double u, double v) const {
  const auto value = [&](size_t k) {
    return k < nets_.size() ? nets_[k].at({u, v}) : Eigen::Vector4d(Eigen::Vector4d::Zero());
  };
  return {value(0), value(1), value(2), value(3), value(4), value(5)};
}

}  // namespace sublimit

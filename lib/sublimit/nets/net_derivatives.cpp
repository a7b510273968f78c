// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/net_derivatives.h"

#include <utility>

namespace sublimit {
namespace {

/// Rows of a net: i = 0 ... `along_u`, and j = 0 ... `along_v`, of triangles less i.
struct NetShape {
  int along_u, along_v;
  bool total;
  int width(int i) const { return (total ? along_v - i : along_v) + 1; }
  Eigen::Index row(int i, int j) const {
    return total ? i * (along_v + 1) - i * (i - 1) / 2 + j : i * (along_v + 1) + j;
  }
  Eigen::Index size() const { return along_u < 0 || along_v < 0 ? 0 : row(along_u, width(along_u) - 1) + 1; }
};

/// Degree times the differences along u or along v.
Points differences(const NetShape& from, const Points& net, const NetShape& to, bool by_u) {
  Points result(to.size(), net.cols());
  const int degree = by_u ? from.along_u : from.along_v;
  for (int i = 0; result.rows() > 0 && i <= to.along_u; ++i)
    for (int j = 0; j < to.width(i); ++j)
      result.row(to.row(i, j)) =
          degree * (net.row(by_u ? from.row(i + 1, j) : from.row(i, j + 1)) - net.row(from.row(i, j)));
  return result;
}

NetShape shape_of(int degree, bool total, int du, int dv) {
  return total ? NetShape{degree - du - dv, degree - du - dv, true} : NetShape{degree - du, degree - dv, false};
}

}  // namespace

NetDerivatives::NetDerivatives(const PolynomialBasis& basis, Points net, int order)
    : degree_(basis.degree()), total_(basis.total()) {
  nets_[0] = std::move(net);
  const auto derive = [&](int du, int dv, bool by_u) {
    const int from_u = by_u ? du - 1 : du, from_v = by_u ? dv : dv - 1;
    nets_[number(du, dv)] = differences(shape_of(degree_, total_, from_u, from_v), nets_[number(from_u, from_v)],
                                        shape_of(degree_, total_, du, dv), by_u);
  };
  derive(1, 0, true);
  derive(0, 1, false);
  if (order < 2) return;
  derive(2, 0, true);
  derive(1, 1, false);
  derive(0, 2, false);
}

Eigen::Vector4d NetDerivatives::value(int du, int dv, double u, double v) const {
  Points b = net(du, dv);
  Eigen::Vector4d result = Eigen::Vector4d::Zero();
  if (b.rows() == 0) return result;
  const NetShape shape = shape_of(degree_, total_, du, dv);
  if (total_) {
    for (int left = shape.along_u; left > 0; --left)
      for (int i = 0; i < left; ++i)
        for (int j = 0; i + j < left; ++j)
          b.row(shape.row(i, j)) =
              (1 - u - v) * b.row(shape.row(i, j)) + u * b.row(shape.row(i + 1, j)) + v * b.row(shape.row(i, j + 1));
    result.head(b.cols()) = b.row(0);
    return result;
  }
  for (int left = shape.along_v; left > 0; --left)
    for (int i = 0; i <= shape.along_u; ++i)
      for (int j = 0; j < left; ++j)
        b.row(shape.row(i, j)) = (1 - v) * b.row(shape.row(i, j)) + v * b.row(shape.row(i, j + 1));
  for (int left = shape.along_u; left > 0; --left)
    for (int i = 0; i < left; ++i)
      b.row(shape.row(i, 0)) = (1 - u) * b.row(shape.row(i, 0)) + u * b.row(shape.row(i + 1, 0));
  result.head(b.cols()) = b.row(0);
  return result;
}

NetDerivatives::Jet NetDerivatives::at(double u, double v) const {
  return {value(0, 0, u, v), value(1, 0, u, v), value(0, 1, u, v),
          value(2, 0, u, v), value(1, 1, u, v), value(0, 2, u, v)};
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/lagrange_basis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/knots.h"

namespace sublimit {

LagrangeBasis::LagrangeBasis(std::vector<double> nodes) : nodes_(std::move(nodes)) {
  const size_t n = nodes_.size();
  if (n < 2) throw InvalidParameter(format_number(n) + " nodes: Lagrange interpolation needs 2 at least");
  for (size_t i = 0; i < n; ++i)
    if (!std::isfinite(nodes_[i]))
      throw InvalidParameter("node " + format_number(i) + " is " + format_number(nodes_[i]) +
                             ": nodes must be finite numbers");
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return nodes_[i]; });
  begin_ = nodes_[order.front()], length_ = nodes_[order.back()] - begin_;
  if (!std::isfinite(length_)) throw InvalidParameter("nodes are farther apart than the largest number");
  for (size_t i = 1; i < n; ++i)
    if (!(unit(nodes_[order[i - 1]]) < unit(nodes_[order[i]])))
      throw InvalidParameter("nodes " + format_number(std::min(order[i - 1], order[i])) + " and " +
                             format_number(std::max(order[i - 1], order[i])) + " are both " +
                             format_number(nodes_[order[i]]) + ": they must be distinct");
  for (double& node : nodes_) node = unit(node);
  // Distances in units of a quarter of the length: products stay near 1 on nodes that are dense at the ends.
  std::vector<long double> exact(n, 1);
  long double largest = 0;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j)
      if (j != i) exact[i] /= 4 * (static_cast<long double>(nodes_[i]) - nodes_[j]);
    largest = std::max(largest, std::abs(exact[i]));
  }
  for (const long double w : exact) weights_.push_back(static_cast<double>(w / largest));
  if (!std::ranges::all_of(weights_, [](double w) { return std::isnormal(w); }))
    throw InvalidParameter(format_number(n) +
                           " nodes: their barycentric weights leave the range of numbers; take fewer");
  const Eigen::Index size = static_cast<Eigen::Index>(n);
  D_ = Eigen::MatrixXd::Zero(size, size);
  for (size_t i = 0; i < n; ++i) {
    long double sum = 0;
    for (size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const long double slope = exact[j] / exact[i] / (static_cast<long double>(nodes_[i]) - nodes_[j]);
      D_(Eigen::Index(i), Eigen::Index(j)) = static_cast<double>(slope);
      sum += D_(Eigen::Index(i), Eigen::Index(j));
    }
    D_(Eigen::Index(i), Eigen::Index(i)) = static_cast<double>(-sum);  // rows of derivatives sum to 0
  }
}

WeightRows LagrangeBasis::rows(double u, int order) const {
  WeightRows result = WeightRows::Zero(order + 1, size());
  const auto node = std::ranges::find(nodes_, u);
  if (node != nodes_.end()) {
    result(0, node - nodes_.begin()) = 1;
  } else {
    for (Index i = 0; i < size(); ++i) result(0, i) = weights_[size_t(i)] / (u - nodes_[size_t(i)]);
    result.row(0) /= result.row(0).sum();
  }
  for (int r = 1; r <= order; ++r) result.row(r) = result.row(r - 1) * D_;
  return result;
}

void LagrangeBasis::check_inside(double t) const {
  if (!(t >= begin() && t <= end())) refuse_parameter(t, begin(), end());
}

}  // namespace sublimit

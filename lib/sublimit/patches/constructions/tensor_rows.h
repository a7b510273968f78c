// SPDX-License-Identifier: Apache-2.0
#pragma once
// Helpers of tensor-product patches: outer products of rows in u and rows in v, and types as bytes.
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "sublimit/source/rational.h"

namespace sublimit {

/// Appends the count of some numbers, and the numbers, as bytes.
inline void append_bytes(std::string& bytes, std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  char item[sizeof(double)];
  std::memcpy(item, &count, sizeof item);
  bytes.append(item, sizeof item);
  for (const double value : values) {
    std::memcpy(item, &value, sizeof item);
    bytes.append(item, sizeof item);
  }
}

/// Orders in u and v of position, du, dv, duu, duv, dvv.
inline constexpr std::pair<int, int> derivative_orders[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};

/// Computes outer products of rows, u fastest: position, then derivatives up to `order`.
inline void tensor_rows(const WeightRows& u, const WeightRows& v, int order, WeightRows& weights) {
  weights.resize(order == 0 ? 1 : order == 1 ? 3 : 6, u.cols() * v.cols());
  for (Eigen::Index r = 0; r < weights.rows(); ++r)
    for (Eigen::Index j = 0; j < v.cols(); ++j)
      weights.row(r).segment(j * u.cols(), u.cols()) =
          v(derivative_orders[r].second, j) * u.row(derivative_orders[r].first);
}

}  // namespace sublimit

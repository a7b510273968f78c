// SPDX-License-Identifier: Apache-2.0
#pragma once
// Helpers of tensor-product patches: outer products of rows in u and rows in v, and types as bytes.
#include <cstring>
#include <span>
#include <string>

#include "sublimit/patches/patch.h"

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

/// Computes outer products of rows, u fastest: position, then derivatives up to `order`.
inline void tensor_rows(const WeightRows& u, const WeightRows& v, int order, WeightRows& weights) {
  product_rows({u.data(), size_t(u.size())}, u.cols(), {v.data(), size_t(v.size())}, v.cols(), order, weights);
}

}  // namespace sublimit

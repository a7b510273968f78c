// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/triangle_blossom.h"

#include <utility>

namespace sublimit {

std::vector<double> triangle_blossom(std::span<const Barycentric> arguments) {
  const auto place = [](size_t n, size_t j, size_t k) { return k * (n + 1) - k * (k - 1) / 2 + j; };
  std::vector<double> weights{1};
  for (size_t q = 1; q <= arguments.size(); ++q) {
    const auto [a, b, c] = arguments[q - 1];
    std::vector<double> next((q + 1) * (q + 2) / 2, 0);
    for (size_t k = 0; k < q; ++k)
      for (size_t j = 0; j + k < q; ++j) {
        const double weight = weights[place(q - 1, j, k)];
        next[place(q, j, k)] += a * weight;
        next[place(q, j + 1, k)] += b * weight;
        next[place(q, j, k + 1)] += c * weight;
      }
    weights = std::move(next);
  }
  return weights;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/triangle_thirds.h"

#include <algorithm>
#include <vector>

#include "sublimit/cad/cad_cells.h"
#include "sublimit/core/detail/binomial.h"
#include "sublimit/nets/triangle_blossom.h"

namespace sublimit {

std::array<Eigen::MatrixXd, 3> triangle_thirds(int degree) {
  const int n = degree;
  std::array<Eigen::MatrixXd, 3> thirds;
  for (size_t third = 0; third < 3; ++third) {
    std::array<Barycentric, 4> corners;
    const auto at = third_of_triangle({{0, 0}, {1, 0}, {0, 1}}, third);
    for (size_t c = 0; c < 4; ++c) corners[c] = {1 - at[c][0] - at[c][1], at[c][0], at[c][1]};
    Eigen::MatrixXd net = Eigen::MatrixXd::Zero((n + 1) * (n + 1), (n + 1) * (n + 2) / 2);
    // The coefficient of B_i(s) B_j(t): of n factors j are B(s), and k of these and i - k of the others are at s = 1.
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        for (int k = std::max(0, i - (n - j)); k <= std::min(i, j); ++k) {
          std::vector<Barycentric> arguments;
          const int counts[] = {n - j - (i - k), i - k, k, j - k};
          for (size_t c = 0; c < 4; ++c) arguments.insert(arguments.end(), size_t(counts[c]), corners[c]);
          const std::vector<double> row = triangle_blossom(arguments);
          const double share = double(binomial(n - j, i - k) * binomial(j, k)) / double(binomial(n, i));
          for (size_t c = 0; c < row.size(); ++c) net(i + (n + 1) * j, Eigen::Index(c)) += share * row[c];
        }
    thirds[third] = std::move(net);
  }
  return thirds;
}

}  // namespace sublimit

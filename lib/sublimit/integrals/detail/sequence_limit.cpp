// SPDX-License-Identifier: Apache-2.0
#include "sublimit/integrals/detail/sequence_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace sublimit {

double sequence_limit(std::span<const double> s) {
  double size = 0;
  for (const double x : s) size = std::max(size, std::abs(x));
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * size;
  // Columns 0, 2, 4 ... of the table are estimates, those between reciprocals of differences.
  std::vector<double> before(s.size(), 0.0), column(s.begin(), s.end());
  double best = s.back(), moved = std::numeric_limits<double>::infinity();
  for (bool estimates = true; column.size() > 1; estimates = !estimates) {
    std::vector<double> next;
    for (size_t i = 0; i + 1 < column.size(); ++i) {
      const double difference = column[i + 1] - column[i];
      if (difference == 0 || (estimates && std::abs(difference) <= rounding)) return best;
      next.push_back(before[i + 1] + 1 / difference);
    }
    before = std::exchange(column, std::move(next));
    if (estimates) continue;
    // A column that goes farther than the one before has found no power but noise.
    const double move = std::abs(column.back() - best);
    if (!(move < moved)) return best;
    moved = move;
    best = column.back();
  }
  return best;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
// How far the limit of a piece leaves its points.
#include <algorithm>
#include <unordered_set>
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

bool PieceType::has_only_means() const {
  if (const int known = only_means_.load(std::memory_order_acquire); known != 0) return known == 2;
  std::vector<const PieceType*> met{this};
  std::unordered_set<const PieceType*> seen{this};
  bool is = true;
  for (size_t i = 0; is && i < met.size(); ++i)
    for (const PieceLink& link : met[i]->children()) {
      const int known = link.type->only_means_.load(std::memory_order_acquire);
      is = link.block.least_weight() > -1e-15 && known != 1;
      if (!is) break;
      if (known == 0 && seen.insert(link.type).second) met.push_back(link.type);
    }
  // What they all come to has been seen, or was known.
  if (is)
    for (const PieceType* type : met) type->only_means_.store(2, std::memory_order_release);
  else
    only_means_.store(1, std::memory_order_release);
  return is;
}

double PieceType::found_reach() const {
  if (has_only_means()) return 0;
  double most = 0;
  const int corners = kind_ == Piece::Kind::triangle ? 3 : 4;
  for (const PieceLink& link : children())
    for (int c = 0; c < corners; ++c) {
      const RowMatrix row = link.block.pulled_back(link.type->corner_limit(c));
      const double own = 1 - row.sum();  // of slot 0
      most = std::max(most, row.cwiseMin(0).cwiseAbs().sum() + std::max(0.0, -own));
    }
  return 2 * most;
}

}  // namespace sublimit

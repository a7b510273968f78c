// SPDX-License-Identifier: Apache-2.0
#pragma once
// The plane around a sector: sector 0 and its neighbours unrolled, so that regular parts of a neighbourhood
// have the coordinates of a regular mesh. Places opposite to sector 0 are ambiguous and have no label.
#include <optional>

#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// Returns the label of a place of the plane around sector 0 of n, in the normal form of sector_labels.h with
/// sectors 0 to n - 1; nothing if it has none.
inline std::optional<SectorLabel> label_at(LatticePoint p, bool triangular, int n) {
  int sector = 0;
  if (p.y2 < 0) {
    if (triangular ? p.x2 + p.y2 < 0 : p.x2 < 0) return std::nullopt;
    p = {-p.y2, triangular ? p.x2 + p.y2 : p.x2};
    sector = -1;
  } else if (p.x2 < 0) {
    if (triangular && p.x2 + p.y2 < 0) return std::nullopt;
    p = {triangular ? p.x2 + p.y2 : p.y2, -p.x2};
    sector = 1;
  }
  if (p == LatticePoint{}) return SectorLabel{};
  if (p.x2 == 0) {
    p = {p.y2, 0};
    ++sector;
  }
  return SectorLabel{(sector + n) % n, p.x2, p.y2};
}

/// Returns the number of the ring of a place around the centre, in halves.
inline int ring2(LatticePoint p, bool triangular) { return triangular ? p.x2 + p.y2 : std::max(p.x2, p.y2); }

}  // namespace sublimit

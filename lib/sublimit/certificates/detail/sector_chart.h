// SPDX-License-Identifier: Apache-2.0
#pragma once
// The plane around a sector: sector 0 and its neighbours unrolled, so that the regular part of a neighbourhood reads
// like the regular mesh. What would lie on both sides of the centre at once has no label.
#include <optional>

#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// The label of a point of the plane around sector `0` of n; in the normal form of sector_labels.h, sectors 0 to n - 1.
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

/// Rings from the centre, in halves: corners of cells have even ones.
inline int ring2(LatticePoint p, bool triangular) { return triangular ? p.x2 + p.y2 : std::max(p.x2, p.y2); }

}  // namespace sublimit

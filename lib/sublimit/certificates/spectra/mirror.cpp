// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/mirror.h"

#include <algorithm>
#include <map>

namespace sublimit {

SectorLabel mirrored(const SectorLabel& label, int n, bool closed) {
  if (label.x2 == 0 && label.y2 == 0) return label;
  if (label.y2 != 0) return {n - 1 - label.sector, label.y2, label.x2};
  const int spoke = n - label.sector;
  return {closed && spoke == n ? 0 : spoke, label.x2, 0};
}

std::optional<ExactRows> mirror_rows(const LocalPatch<Algebraic>& patch) {
  // An open fan has points on a spoke of its own at its end.
  const bool closed = std::none_of(patch.labels.begin(), patch.labels.end(),
                                   [&](const SectorLabel& label) { return label.sector == patch.type.faces; });
  std::map<SectorLabel, Index> at;
  for (size_t i = 0; i < patch.labels.size(); ++i) at[patch.labels[i]] = static_cast<Index>(i);
  Orbits pairs;
  for (Index i = 0; i < std::ssize(patch.labels); ++i) {
    const auto image = at.find(mirrored(patch.labels[size_t(i)], patch.type.faces, closed));
    if (image == at.end()) return std::nullopt;
    if (image->second > i) pairs.push_back({i, image->second});
    if (image->second == i) pairs.push_back({i});
  }
  return exact_rows(patch.A, std::move(pairs));
}

}  // namespace sublimit

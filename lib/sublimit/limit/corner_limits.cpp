// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/corner_limits.h"

#include "sublimit/base/error.h"
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {

const LimitRows* CornerLimits::at(const Centre& centre) const {
  const std::pair key{int(centre.kind), index(centre.start)};
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end()) return at->second ? &*at->second : nullptr;
  }
  std::optional<LimitRows> limit;
  try {
    const Centre of = centre.kind == Centre::Kind::vertex ? side_of(level_, centre.start) : centre;
    limit = limit_rows(level_, masks_, {of})[0];
  } catch (const AnalysisError&) {
    // No tangents here; the position is known by the piece.
  }
  const std::lock_guard lock(mutex_);
  const auto& entry = known_.try_emplace(key, std::move(limit)).first->second;
  return entry ? &*entry : nullptr;
}

}  // namespace sublimit

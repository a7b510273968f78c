// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/corner_limits.h"

#include "sublimit/base/error.h"
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {

const LimitRows* CornerLimits::at(const Centre& centre) const {
  const std::pair key{int(centre.kind), index(centre.start)};
  const std::optional<LimitRows>& limit = known_.get(key, [&]() -> std::optional<LimitRows> {
    try {
      const Centre of = centre.kind == Centre::Kind::vertex ? side_of(level_, centre.start) : centre;
      return limit_rows(level_, masks_, of);
    } catch (const AnalysisError&) {
      return std::nullopt;  // no tangents here; the position is known by the piece
    }
  });
  return limit ? &*limit : nullptr;
}

std::optional<LimitRows::Row> CornerLimits::position(HalfEdge corner) const {
  const LimitRows* const limit = at(first_side(level_, corner));
  if (!limit) return std::nullopt;
  return limit->position();
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of the places where pieces meet that are no polynomials: vertices of a level, and middles of its faces. Their
// tangents are those of the characteristic map, or of one side of a crease.
#include <optional>
#include <utility>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/limit/detail/limit_rows.h"

namespace sublimit {

/// Limits at corners, computed when first needed and cached. Threads may share it.
class CornerLimits {
 public:
  /// @param masks  of the scheme, shared with other levels; must stay
  /// @param level  which must stay
  CornerLimits(LimitCache& masks, const Level& level) : level_(level), masks_(masks) {}
  CornerLimits(LimitCache&, const Level&&) = delete;
  /// Null where there is no limit. A vertex is seen from the face of `centre.start`.
  const LimitRows* at(const Centre& centre) const;

 private:
  const Level& level_;
  LimitCache& masks_;
  FoundByKey<std::pair<int, Index>, std::optional<LimitRows>> known_;
};

}  // namespace sublimit

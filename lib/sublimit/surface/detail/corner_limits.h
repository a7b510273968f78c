// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits at corners of non-polynomial pieces: at vertices of a level and middles of its faces. Tangents come
// from the limit masks: those of the characteristic map, or of one side of a crease.
#include <optional>
#include <utility>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/limit/detail/limit_rows.h"

namespace sublimit {

/// Limits at corners, computed when first needed and cached. Threads may share it.
class CornerLimits {
 public:
  /// @param masks  cache of the scheme's limits, may be shared with other levels; must outlive this
  /// @param level  must outlive this
  CornerLimits(LimitCache& masks, const Level& level) : level_(level), masks_(masks) {}
  CornerLimits(LimitCache&, const Level&&) = delete;
  /// Returns the limit at a centre, or null if there is none. For a vertex it is that of the side with the face
  /// of `centre.start`.
  const LimitRows* at(const Centre& centre) const;
  /// Returns the weights of the limit position of a corner's vertex, on the sheet of its face: those of
  /// `limit_matrices`, which at a vertex of several sheets has the first. Nothing if there is no limit.
  std::optional<LimitRows::Row> position(HalfEdge corner) const;

 private:
  const Level& level_;
  LimitCache& masks_;
  FoundByKey<std::pair<int, Index>, std::optional<LimitRows>> known_;
};

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/limit_cache.h"

#include "sublimit/scheme/detail/made_by.h"

namespace sublimit {

const IsolatedLimit* LimitCache::isolated(const LocalType& type) {
  const std::optional<IsolatedLimit>& limit = isolated_.get(type, [&] { return isolated_limit(scheme_, type); });
  return limit ? &*limit : nullptr;
}

void LimitCache::check(const Level& level) {
  if (!level.made_by) return;
  {
    const std::lock_guard lock(made_by_mutex_);
    if (made_by_.lock() == level.made_by) return;
  }
  check_made_by(level, scheme_, "the cache");
  trust(level);
}

void LimitCache::trust(const Level& level) {
  const std::lock_guard lock(made_by_mutex_);
  made_by_ = level.made_by;
}

const LimitMasks& LimitCache::masks(const CanonicalNeighborhood& type) {
  return types_.get(type.signature(), [&] { return limit_masks(scheme_, type); });
}

}  // namespace sublimit

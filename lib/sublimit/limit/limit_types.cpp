// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_types.h"

#include "sublimit/scheme/made_by.h"

namespace sublimit {

const LoneLimit* LimitTypes::lone(const LocalType& type) {
  const std::optional<LoneLimit>& limit = lone_.get(type, [&] { return lone_limit(scheme_, type); });
  return limit ? &*limit : nullptr;
}

void LimitTypes::check(const Level& level) {
  if (!level.made_by) return;
  {
    const std::lock_guard lock(made_by_mutex_);
    if (made_by_.lock() == level.made_by) return;
  }
  check_made_by(level, scheme_, "the dictionary of types (LimitTypes)");
  trust(level);
}

void LimitTypes::trust(const Level& level) {
  const std::lock_guard lock(made_by_mutex_);
  made_by_ = level.made_by;
}

const LimitMasks& LimitTypes::masks(const CanonicalNeighborhood& type) {
  return types_.get(type.signature(), [&] { return limit_masks(scheme_, type); });
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_types.h"

#include "sublimit/scheme/made_by.h"

namespace sublimit {

const LoneLimit* LimitTypes::lone(const LocalType& type) {
  const std::lock_guard lock(mutex_);
  const auto [at, is_new] = lone_.try_emplace(type);
  if (is_new) at->second = lone_limit(scheme_, type);
  return at->second ? &*at->second : nullptr;
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
  std::vector<std::uint32_t> key = type.signature();
  const auto found = types_.find(key);
  if (found != types_.end()) return *found->second;
  auto masks = std::make_shared<const LimitMasks>(limit_masks(scheme_, type));
  return *types_.emplace(std::move(key), std::move(masks)).first->second;
}

}  // namespace sublimit

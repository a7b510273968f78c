// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_types.h"

namespace sublimit {

const LoneLimit* LimitTypes::lone(const LocalType& type) {
  const std::lock_guard lock(mutex_);
  const auto [at, is_new] = lone_.try_emplace(type);
  if (is_new) at->second = lone_limit(scheme_, type);
  return at->second ? &*at->second : nullptr;
}

const LimitMasks& LimitTypes::masks(const CanonicalNeighborhood& type) {
  std::vector<std::uint32_t> key = type.signature();
  const auto found = types_.find(key);
  if (found != types_.end()) return *found->second;
  auto masks = std::make_shared<const LimitMasks>(limit_masks(scheme_, type));
  return *types_.emplace(std::move(key), std::move(masks)).first->second;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_types.h"

namespace sublimit {

const LoneLimit* LimitTypes::lone(const LocalType& type) {
  const std::optional<LoneLimit>& limit = lone_.get(type, [&] { return lone_limit(scheme_, type); });
  return limit ? &*limit : nullptr;
}

const LimitMasks& LimitTypes::masks(const CanonicalNeighborhood& type) {
  return types_.get(type.signature(), [&] { return limit_masks(scheme_, type); });
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/signature_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace sublimit {

size_t SignatureHash::operator()(const std::vector<std::uint32_t>& words) const {
  return XXH3_64bits(words.data(), words.size() * sizeof(words[0]));
}

}  // namespace sublimit

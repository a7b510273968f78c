// SPDX-License-Identifier: Apache-2.0
#pragma once
// Hash of a signature: the words that say of what type a neighbourhood or a piece is.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sublimit {

struct SignatureHash {
  size_t operator()(const std::vector<std::uint32_t>& words) const {
    std::uint64_t h = 0xcbf29ce484222325u;  // FNV-1a by words
    for (const std::uint32_t w : words) h = (h ^ w) * 0x100000001b3u;
    return h ^ (h >> 29);
  }
};

}  // namespace sublimit

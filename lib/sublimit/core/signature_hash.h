// SPDX-License-Identifier: Apache-2.0
#pragma once
// Hash of a signature: the words that say of what type a neighbourhood or a piece is.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sublimit {

struct SignatureHash {
  size_t operator()(const std::vector<std::uint32_t>& words) const {
    // FNV-1a by two words at a time, in two lanes: multiplications are what takes the time.
    constexpr std::uint64_t prime = 0x100000001b3u;
    std::uint64_t lane[2] = {0xcbf29ce484222325u, words.size()};
    size_t i = 0;
    for (; i + 3 < words.size(); i += 4)
      for (int k = 0; k < 2; ++k)
        lane[k] = (lane[k] ^ (words[i + 2 * k] + (std::uint64_t{words[i + 2 * k + 1]} << 32))) * prime;
    for (; i < words.size(); ++i) lane[0] = (lane[0] ^ words[i]) * prime;
    lane[0] = (lane[0] ^ (lane[1] >> 32) ^ (lane[1] << 32)) * prime;
    return lane[0] ^ (lane[0] >> 29);
  }
};

}  // namespace sublimit

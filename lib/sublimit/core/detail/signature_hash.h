// SPDX-License-Identifier: Apache-2.0
#pragma once
// Hash of a signature: the words that identify the type of a neighbourhood or a piece.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sublimit {

struct SignatureHash {
  size_t operator()(const std::vector<std::uint32_t>& words) const;
};

}  // namespace sublimit

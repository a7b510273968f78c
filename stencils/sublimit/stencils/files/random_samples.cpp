// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/random_samples.h"

#include <algorithm>

namespace sublimit {

/// 0 to end - 1, each as often: numbers of the last, incomplete round are drawn again.
std::uint64_t RandomSamples::below(std::uint64_t end) {
  const std::uint64_t excess = (0 - end) % end;  // 2^64 mod end
  std::uint64_t number = numbers_();
  while (number < excess) number = numbers_();
  return number % end;
}

/// A multiple of 2^-53 in [0, 1).
double RandomSamples::fraction() { return double(numbers_() >> 11) * 0x1p-53; }

void RandomSamples::read(std::vector<Place>& batch, size_t most) {
  const std::int64_t count = std::min(left_, static_cast<std::int64_t>(most));
  left_ -= count;
  batch.resize(size_t(count));
  for (Place& s : batch) {
    s.face = static_cast<Index>(below(std::uint64_t(faces_.size)));
    s.u = fraction();
    s.v = fraction();
    if (faces_.triangles && s.u + s.v > 1) {  // the other half of the square; both differences are exact
      s.u = 1 - s.u;
      s.v = 1 - s.v;
    }
  }
}

}  // namespace sublimit

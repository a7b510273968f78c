// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random places on a limit surface. A seed gives the same places on every platform.
#include <cstdint>
#include <random>
#include <vector>

#include "sublimit/source/address.h"

namespace sublimit {

/// Samples that are uniform over addresses and over the parameters of each address. The standard fixes the
/// numbers of std::mt19937_64, but not those of its distributions, so that this class maps numbers itself.
class RandomSamples {
 public:
  /// @param count  number of all samples
  RandomSamples(FaceCount faces, std::int64_t count, std::uint64_t seed)
      : faces_(faces), left_(faces.size > 0 ? count : 0), numbers_(seed) {}

  /// Sets `batch` to the next samples, `most` of them, or fewer at the end. The sequence does not depend on the
  /// sizes of batches.
  void read(std::vector<Place>& batch, size_t most);

 private:
  std::uint64_t below(std::uint64_t end);
  double fraction();

  FaceCount faces_;
  std::int64_t left_;
  std::mt19937_64 numbers_;
};

}  // namespace sublimit

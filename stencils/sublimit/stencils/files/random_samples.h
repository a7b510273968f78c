// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random places on a limit surface, the same ones on every platform for a seed.
#include <cstdint>
#include <random>
#include <vector>

#include "sublimit/source/address.h"

namespace sublimit {

/// Samples uniform over addresses and over the parameters of each. The standard fixes what std::mt19937_64 gives, but
/// not what its distributions make of it, so numbers are mapped here.
class RandomSamples {
 public:
  /// @param count  of samples in all
  RandomSamples(FaceCount faces, std::int64_t count, std::uint64_t seed)
      : faces_(faces), left_(faces.size > 0 ? count : 0), numbers_(seed) {}

  /// The next samples: `batch` becomes at most `most` long, shorter only at the end. Their order does not depend on how
  /// they are asked for.
  void read(std::vector<Place>& batch, size_t most);

 private:
  std::uint64_t below(std::uint64_t end);
  double fraction();

  FaceCount faces_;
  std::int64_t left_;
  std::mt19937_64 numbers_;
};

}  // namespace sublimit

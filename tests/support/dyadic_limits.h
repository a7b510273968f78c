// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits near the corners of quadrilaterals by refinement alone: (i/2^k, j/2^k) is a vertex of level k, whose limit
// masks are exact. Of each level only the neighbourhood of the corner is made.
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/address.h"

namespace sublimit::testing {

/// A corner of the square of an address, 0 to 3 from (0,0) on, counter-clockwise.
struct SquareCorner {
  enum class Kind {
    regular,
    smooth,  ///< another valence than 4, nothing sharp
    sharp,   ///< at a sharp edge or boundary, or sharp itself; but for infinite creases between two quads on each side
  };
  Index address = 0, corner = 0;
  Kind kind = Kind::regular;
};

struct DyadicLimit {
  int exponent = 0;  ///< 2^-exponent is the distance to the corner, the larger one of those along u and v
  Place place;
  Eigen::Vector3d position, normal;
  bool has_normal = false;
};

/// Of schemes that split every face into quadrilaterals and have primal, narrow masks.
class DyadicLimits {
 public:
  DyadicLimits(const Scheme<double>& scheme, const Mesh& mesh);

  const Addresses& addresses() const { return addresses_; }
  /// All corners of all squares, but those of holes.
  std::vector<SquareCorner> corners() const;

  /// At distances a = 2^-1 ... 2^-last from a corner, the limits of (a, a), (a, a/2) and (a/2, a), counted from the
  /// corner along its two edges: inside the square.
  std::vector<DyadicLimit> towards(const SquareCorner& corner, int last);

 private:
  Scheme<double> scheme_;
  Points points_;
  Level level_;
  Addresses addresses_;
  LimitCache cache_;
};

}  // namespace sublimit::testing

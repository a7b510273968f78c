// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits near the corners of quadrilaterals by refinement only: (i/2^k, j/2^k) is a vertex of level k, and
// limit masks at vertices are exact. Only the neighbourhood of the corner is refined.
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/address.h"

namespace sublimit::testing {

/// A corner of the square of an address, 0 to 3 from (0,0) on, counter-clockwise.
struct SquareCorner {
  enum class Kind {
    regular,
    smooth,  ///< valence other than 4, nothing sharp
    sharp,   ///< sharp, or at a sharp edge or boundary, except creases with two quads on each side
  };
  Index address = 0, corner = 0;
  Kind kind = Kind::regular;
};

struct DyadicLimit {
  int exponent = 0;  ///< 2^-exponent is the larger of the distances along u and v to the corner
  Place place;
  Eigen::Vector3d position, normal;
  bool has_normal = false;
};

/// Limits for schemes that split every face into quadrilaterals and have primal, narrow masks.
class DyadicLimits {
 public:
  DyadicLimits(const Scheme<double>& scheme, const Mesh& mesh);

  const Addresses& addresses() const { return addresses_; }
  /// Returns all corners of all squares, without those of holes.
  std::vector<SquareCorner> corners() const;

  /// Returns the limits at (a, a), (a, a/2) and (a/2, a) for a = 2^-1 ... 2^-last, with parameters along the
  /// two edges from the corner into the square.
  std::vector<DyadicLimit> towards(const SquareCorner& corner, int last);

 private:
  Scheme<double> scheme_;
  Points points_;
  Level level_;
  Addresses addresses_;
  LimitCache cache_;
};

}  // namespace sublimit::testing

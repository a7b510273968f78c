// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface with its points: patches as polynomials in space, evaluated many at a time.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/limit/detail/limit_map_parts.h"

namespace sublimit {

class LimitPatches {
 public:
  /// Finds the types of all pieces, and binds all patches to `points`, in parallel.
  /// @param parts   which must stay
  /// @param points  #V x 3; must stay
  LimitPatches(const LimitMap::Parts& parts, const Points& points);
  LimitPatches(const LimitMap::Parts&&, const Points&) = delete;
  LimitPatches(const LimitMap::Parts&, const Points&&) = delete;

  /// Rows [begin, end) of `out`, whose other rows and absent quantities stay as they are.
  /// @return  places in types whose rows had to be made, since no patch has them: alike ones count once
  std::int64_t evaluate(std::span<const Place> samples, std::int64_t begin, std::int64_t end, int order, bool normals,
                        LimitSamples& out) const;

  /// Returns the parts of a map, for code that divides a surface in other ways.
  static const LimitMap::Parts& parts_of(const LimitMap& surface) { return *surface.parts_; }

 private:
  struct Loop;
  const LimitMap::Parts& parts_;
  const Points& points_;
  const LimitMap::Parts::Pieces& pieces_;
  struct Bound {
    const PatchTree* tree = nullptr;
    std::int64_t first = 0;   // of its coefficients
    std::uint16_t sides = 0;  // Parts::sides
  };
  std::vector<Bound> bound_;                  // by piece
  UninitializedVector<double> coefficients_;  // x, y, z each, and one more
};

/// Makes room for so many rows of what is asked for.
void resize(LimitSamples& out, std::int64_t count, int order, bool normals);

/// @throws InvalidParameter  points that are not as many as the level has, with three coordinates each
void check_points(const Level& level, const Points& points);

/// Samples in a block: some tens of microseconds.
inline constexpr std::int64_t samples_per_block = 2048;

}  // namespace sublimit

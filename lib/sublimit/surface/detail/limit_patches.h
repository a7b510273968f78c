// SPDX-License-Identifier: Apache-2.0
#pragma once
// Evaluation of many places of a limit surface with given points: its polynomial patches in space are computed
// once, then evaluated.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {

/// Polynomial patches of a limit surface, bound to points.
class LimitPatches {
 public:
  /// Finds the types of all pieces, and binds all patches to `points`, in parallel.
  /// @param parts   must outlive this
  /// @param points  #V x 3; must outlive this
  LimitPatches(const LimitMap::Parts& parts, const Points& points);
  LimitPatches(const LimitMap::Parts&&, const Points&) = delete;
  LimitPatches(const LimitMap::Parts&, const Points&&) = delete;

  /// Evaluates places [begin, end) into the same rows of `out`. Other rows and absent quantities are not
  /// touched.
  /// @return  number of rows of weights that were computed for places that are in no patch; equal places in
  ///          pieces of one type count once
  std::int64_t evaluate(std::span<const Place> samples, std::int64_t begin, std::int64_t end, int order, bool normals,
                        LimitSamples& out) const;

 private:
  struct Loop;
  const LimitMap::Parts& parts_;
  const Points& points_;
  const LimitMap::Parts::Pieces& pieces_;
  struct Bound {
    const PatchTree* tree = nullptr;
    std::int64_t first = 0;   // start of its coefficients
    std::uint16_t sides = 0;  // Parts::sides
  };
  std::vector<Bound> bound_;                  // by piece
  UninitializedVector<double> coefficients_;  // x, y, z each, and one number of padding
};

/// Resizes the quantities that `order` and `normals` request to `count` rows, the others to none.
void resize(LimitSamples& out, std::int64_t count, int order, bool normals);

/// Throws unless points are #V x 3 for a level.
/// @throws InvalidParameter  points of another shape
void check_points(const Level& level, const Points& points);

/// Number of samples in a parallel block, which takes some tens of microseconds.
inline constexpr std::int64_t samples_per_block = 2048;

}  // namespace sublimit

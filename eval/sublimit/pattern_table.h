// SPDX-License-Identifier: Apache-2.0
#pragma once
// A baked table by patterns: a stencil depends on what its neighbourhood is like, and few kinds of neighbourhoods
// occur. Each is one dense block of weights; a patch says which block, and which control points. Knows no scheme and no
// mesh.
//
//   points of a patch = (chosen rows of its block) * (its control points)
//
// A point may have derivatives beside its position. All quantities of a point have the same columns.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sublimit/stencil_table.h"

namespace sublimit {

/// Numbers of matrices for positions and derivatives of order 0, 1 or 2.
constexpr int num_quantities(int derivatives) { return derivatives == 0 ? 1 : derivatives == 1 ? 3 : 6; }

template <class Real>
class PatternTable {
 public:
  /// As many matrices as there are quantities, one after the other, each row by row.
  struct Block {
    std::int32_t rows = 0, columns = 0;
    std::int64_t weights = 0;  ///< where it begins in `weights`
  };
  /// Patches of one block that make the same rows of it. They and their points follow those of the group before.
  struct Group {
    std::int32_t block = 0;
    std::int32_t num_rows = 0;
    std::int64_t rows = 0;  ///< where its rows begin in `rows`
    std::int64_t num_patches = 0;
  };
  struct Arrays {
    /// Of a point: 1 is its position; 3 the derivatives along u and v too; 6 those along uu, uv and vv as well.
    int quantities = 1;
    std::vector<Block> blocks;
    SharedArray<Real> weights;
    std::vector<Group> groups;
    SharedArray<std::int32_t> rows;     ///< numbers of rows within a block
    SharedArray<std::int32_t> columns;  ///< control points of each patch, group by group
    /// Where the points of each patch begin; empty: each patch's follow those of the patch before.
    SharedArray<std::int64_t> patch_points;
    /// Pairs (to, from): a point that lies on several patches is made once, and its position copied at the end.
    SharedArray<std::int32_t> copies;
    /// Where most types are rare: a step by rows that makes the points which all else is applied to.
    std::optional<StencilTable<Real>> first;
    /// Points of no patch: after all others, a row for each; all positions first, then all derivatives along u, ...
    std::optional<StencilTable<Real>> rest;
  };

  PatternTable() = default;
  /// @param num_control_points  points that the table is applied to
  /// @throws InvalidParameter  arrays that do not fit together, a number out of range, a weight that is not finite
  PatternTable(std::int32_t num_control_points, Arrays arrays);

  std::int64_t num_points() const { return num_points_; }
  std::int32_t num_control_points() const { return num_control_points_; }
  int quantities() const { return arrays_.quantities; }
  const Arrays& arrays() const { return arrays_; }
  /// Bytes of all arrays.
  std::int64_t num_bytes() const;

  /// new points = table * control points, in parallel, the same bits for any number of threads.
  /// @param points    num_control_points x channels, interleaved
  /// @param result    quantities x num_points x channels, interleaved: all positions first; must not overlap `points`
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// What `apply` throws for, alone.
  void check(std::span<const Real> points, int channels, std::span<const Real> result) const;

  /// Points that patches are applied to: those given, or what the first step makes of them.
  /// @param made  keeps these
  std::span<const Real> inputs(std::span<const Real> points, int channels, std::unique_ptr<Real[]>& made) const;

  /// What is left when all patches have their points: points of no patch, copies.
  /// @param inputs  of patches
  void apply_rest(std::span<const Real> inputs, int channels, std::span<Real> result) const;

  /// Where the points of a patch begin.
  /// @param group  that it is of
  std::int64_t first_point(size_t group, std::int64_t patch) const {
    return arrays_.patch_points.empty()
               ? starts_[group].point + (patch - starts_[group].patch) * arrays_.groups[group].num_rows
               : arrays_.patch_points[patch];
  }

  std::int64_t num_patches() const { return starts_.empty() ? 0 : starts_.back().patch; }
  /// Where a group begins.
  struct Start {
    std::int64_t patch = 0, columns = 0, point = 0;
  };
  std::span<const Start> starts() const { return starts_; }  ///< of each group, and the end
  /// Calls body(group, first patch, number of patches) for the groups that patches [begin, end) are of.
  template <class Body>
  void for_each_run(std::int64_t begin, std::int64_t end, const Body& body) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), begin,
                                        [](std::int64_t patch, const Start& s) { return patch < s.patch; });
    for (auto g = static_cast<size_t>(after - starts_.begin()) - 1; begin < end; ++g) {
      const std::int64_t last = std::min(end, starts_[g + 1].patch);
      if (last > begin) body(g, begin, last - begin);
      begin = std::max(begin, last);
    }
  }

  /// The same by rows, quantities x num_points of them, sums of both steps taken. Columns of a row ascend; weights of
  /// zero are left out.
  StencilTable<Real> expanded() const;

 private:
  std::int32_t num_control_points_ = 0;
  std::int64_t num_points_ = 0;
  Arrays arrays_;
  std::vector<Start> starts_;
};

/// In the other precision: weights are rounded.
[[nodiscard]] StencilTable<float> in_float(const StencilTable<double>& table);
[[nodiscard]] PatternTable<float> in_float(const PatternTable<double>& table);

extern template class PatternTable<float>;
extern template class PatternTable<double>;

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by patterns. A stencil depends on its neighbourhood, and few kinds of neighbourhoods occur: each has one dense
// block of weights. A patch names a block and the control points that it is applied to: points of a patch =
// (selected rows of its block) * (its control points).
//
// A point may have derivatives besides its position; all of them have the same columns. Tables are independent of
// schemes and meshes. One is in every file of a level:
//
//   const Table loaded = load("level3.safetensors");  // eval/table.h
//   const PatternTable<float>& table = std::get<BakedTable<float>>(loaded.baked()).table;
//   std::vector<float> result(3 * table.num_points() * table.quantities());
//   table.apply(points, 3, result);  // points: std::vector<float> of 3 * table.num_control_points() numbers
//   const StencilTable<float> rows = table.expanded();
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sublimit/eval/table/stencil_table.h"

namespace sublimit {

/// Returns the number of quantities of a point with derivatives up to order 0, 1 or 2: 1, 3 or 6.
constexpr int num_quantities(int derivatives) { return derivatives == 0 ? 1 : derivatives == 1 ? 3 : 6; }

/// A table by patterns. Constant once made: any number of threads may share it, and copies share the arrays.
template <class Real>
class PatternTable {
 public:
  /// A block of weights: one matrix for each quantity, one after the other, each row by row.
  struct Block {
    std::int32_t rows = 0, columns = 0;  ///< size of each matrix
    std::int64_t weights = 0;            ///< index of the first weight in `weights`
  };
  /// Patches that use the same rows of one block. They and their points follow those of the previous group.
  struct Group {
    std::int32_t block = 0;        ///< index of the block
    std::int32_t num_rows = 0;     ///< points of each patch
    std::int64_t rows = 0;         ///< index of the first row in `rows`
    std::int64_t num_patches = 0;  ///< number of patches
  };
  /// Data of a table.
  struct Arrays {
    /// Quantities of a point, 1: its position; 3: derivatives along u and v too; 6: those along uu, uv and vv as well.
    int quantities = 1;
    std::vector<Block> blocks;          ///< blocks of weights
    SharedArray<Real> weights;          ///< weights of all blocks
    std::vector<Group> groups;          ///< groups of patches
    SharedArray<std::int32_t> rows;     ///< rows of a block that each group uses
    SharedArray<std::int32_t> columns;  ///< control points of each patch, group by group
    /// Index of the first point of each patch; empty: the points of a patch follow those of the previous patch.
    SharedArray<std::int64_t> patch_points;
    /// Pairs (to, from): a point that lies on several patches is made once, and its position copied at the end.
    SharedArray<std::int32_t> copies;
    /// First step, by rows: makes the points that patches and `rest` are applied to. Absent: the control points.
    std::optional<StencilTable<Real>> first;
    /// Rows of the points of no patch, which are the last points: all positions, then all derivatives along u, ...
    std::optional<StencilTable<Real>> rest;
  };

  /// Makes a table without points.
  PatternTable() = default;
  /// Makes a table of arrays.
  /// @param num_control_points  points that the table is applied to
  /// @throws InvalidParameter  arrays that do not fit together, a number out of range, a weight that is not finite
  PatternTable(std::int32_t num_control_points, Arrays arrays);

  std::int64_t num_points() const { return num_points_; }                  ///< number of points that it makes
  std::int32_t num_control_points() const { return num_control_points_; }  ///< number of points that it is applied to
  int quantities() const { return arrays_.quantities; }                    ///< 1, 3 or 6, see `Arrays`
  const Arrays& arrays() const { return arrays_; }
  /// Returns the size of all arrays in bytes.
  std::int64_t num_bytes() const;

  /// Makes new points = table * control points, in parallel; the same bits for any number of threads.
  /// `PatternEvaluator` is faster.
  /// @param points    num_control_points x channels, interleaved
  /// @param result    quantities x num_points x channels, interleaved: all positions first; must not overlap `points`
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// Checks the arguments of `apply`.
  /// @throws as `apply`
  void check(std::span<const Real> points, int channels, std::span<const Real> result) const;

  /// Returns the points that patches are applied to: `points`, or those that the first step makes of them.
  /// @param made  set to the memory of those that are made
  std::span<const Real> inputs(std::span<const Real> points, int channels, std::unique_ptr<Real[]>& made) const;

  /// Makes the points of no patch, and copies points, after all points of patches are made.
  /// @param inputs  points that patches are applied to, see `inputs`
  void apply_rest(std::span<const Real> inputs, int channels, std::span<Real> result) const;

  /// Returns the index of the first point of a patch.
  /// @param group  group of the patch
  std::int64_t first_point(size_t group, std::int64_t patch) const {
    return arrays_.patch_points.empty()
               ? starts_[group].point + (patch - starts_[group].patch) * arrays_.groups[group].num_rows
               : arrays_.patch_points[patch];
  }

  /// Returns the number of patches.
  std::int64_t num_patches() const { return starts_.empty() ? 0 : starts_.back().patch; }
  /// First patch, entry of `columns` and point of a group.
  struct Start {
    std::int64_t patch = 0, columns = 0, point = 0;
  };
  std::span<const Start> starts() const { return starts_; }  ///< starts of all groups, and the end
  /// Calls body(group, first patch, number of patches) for each group that has some of the patches [begin, end).
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

  /// Returns the table by rows over the control points, quantities x num_points of them, with a first step multiplied
  /// in. Columns of a row ascend; weights of zero are left out.
  StencilTable<Real> expanded() const;

 private:
  std::int32_t num_control_points_ = 0;
  std::int64_t num_points_ = 0;
  Arrays arrays_;
  std::vector<Start> starts_;
};

/// Returns a table with weights rounded to float.
[[nodiscard]] StencilTable<float> in_float(const StencilTable<double>& table);
/// Returns a table with weights rounded to float.
[[nodiscard]] PatternTable<float> in_float(const PatternTable<double>& table);

extern template class PatternTable<float>;
extern template class PatternTable<double>;

}  // namespace sublimit

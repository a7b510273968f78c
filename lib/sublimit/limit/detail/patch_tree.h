// SPDX-License-Identifier: Apache-2.0
#pragma once
// The polynomial patches of a type, ready to be bound to points: the piece itself, or those of its descendants down to
// some depth. What is deeper, towards extraordinary vertices, is left to `piece_rows`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

class PatchTree {
 public:
  /// Largest degree whose patches are bound; the monomials of higher ones would lose digits.
  static constexpr int max_degree = 4;

  explicit PatchTree(const PieceType& type);

  struct Node {
    int first_child = -1;                          ///< its children stand together
    int patch = -1;                                ///< number of its patch; neither: too deep
    const std::deque<PieceLink>* links = nullptr;  ///< to its children
    bool in_four = false;  ///< these are the quarters of a quadrilateral, as it lies, counter-clockwise
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Where the descent of a place may begin: the deepest node, up to `cell_levels` quarterings below the root, that the
  /// whole cell of the place is in.
  struct Cell {
    std::int16_t node = 0, patch = -1;  ///< and its patch
    std::int32_t size = 1;              ///< of the root, in nodes like this one: 2^depth
  };
  static constexpr int cell_levels = 3, cells = 1 << cell_levels;  ///< along each side
  /// @param u, v  in [0, 1]. Cells end with their upper sides, as `PieceType::child` has it.
  const Cell& cell(double u, double v) const {
    const auto row = [](double x) { return std::max(0, static_cast<int>(std::ceil(cells * x)) - 1); };
    return cells_[cells * row(v) + row(u)];
  }
  int num_patches() const { return num_patches_; }
  int num_coefficients() const { return num_coefficients_; }  ///< of a patch
  int degree() const { return degree_; }
  bool total() const { return total_; }
  bool halves() const { return halves_; }  ///< two patches each: u >= v, and u < v
  /// Coefficients of s^i t^j, s = 2u - 1, t = 2v - 1, by i, then j, of all patches, from differences of the piece's
  /// points; the constant ones less slot 0.
  const RowMatrix& matrix() const { return matrix_; }

 private:
  void find_cells();
  std::vector<Node> nodes_;
  std::array<Cell, size_t(cells) * cells> cells_;
  int num_patches_ = 0, num_coefficients_ = 0, degree_ = 0;
  bool total_ = false, halves_ = false;
  RowMatrix matrix_;
};

}  // namespace sublimit

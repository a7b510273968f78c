// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial patches of a type of piece, as rows over its points: the piece itself, or its descendants down to
// some depth. Places in deeper descendants, near extraordinary vertices, are left to `piece_rows`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// Tree of the descendants of a piece with its polynomial patches as leaves.
class PatchTree {
 public:
  /// Largest degree of patches in the tree: monomials of higher degrees lose digits.
  static constexpr int max_degree = 4;

  explicit PatchTree(const PieceType& type);

  struct Node {
    int first_child = -1;                          ///< first child; children are consecutive; -1: none
    int patch = -1;                                ///< number of its patch; -1: none (without children: too deep)
    const std::deque<PieceLink>* links = nullptr;  ///< links to the children
    bool in_four = false;  ///< children are the quarters of a quadrilateral, not rotated, counter-clockwise
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Start of the descent for all places in a cell of a regular grid: the deepest node, at most `cell_levels`
  /// quarterings below the root, that contains the cell. Saves the first steps of each descent.
  struct Cell {
    std::int16_t node = 0, patch = -1;  ///< the node, and its patch
    std::int32_t size = 1;              ///< side of the root in sides of the node: 2^depth
  };
  static constexpr int cell_levels = 3, cells = 1 << cell_levels;  ///< grid of `cells` x `cells`
  /// Returns the cell of a place. A place between two cells belongs to the lower one, as in `PieceType::child`.
  /// @param u, v  in [0, 1]
  const Cell& cell(double u, double v) const {
    const auto row = [](double x) { return std::max(0, static_cast<int>(std::ceil(cells * x)) - 1); };
    return cells_[cells * row(v) + row(u)];
  }
  int num_patches() const { return num_patches_; }
  int num_coefficients() const { return num_coefficients_; }  ///< coefficients of one patch
  int degree() const { return degree_; }
  bool total() const { return total_; }
  bool halves() const { return halves_; }  ///< true if leaves have two patches: for u >= v, and for u < v
  /// Returns the matrix that takes differences of the piece's points, x_j - x_0, to the coefficients of s^i t^j
  /// of all patches, s = 2u - 1, t = 2v - 1, by i, then j. Constant coefficients lack x_0.
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

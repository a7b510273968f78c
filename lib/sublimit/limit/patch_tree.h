// SPDX-License-Identifier: Apache-2.0
#pragma once
// The polynomial patches of a type, ready to be bound to points: the piece itself, or those of its descendants down to
// some depth. What is deeper, towards extraordinary vertices, is left to `piece_rows`.
#include <memory>
#include <vector>

#include "sublimit/limit/piece_types.h"

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
  int num_patches() const { return num_patches_; }
  int num_coefficients() const { return num_coefficients_; }  ///< of a patch
  int degree() const { return degree_; }
  bool total() const { return total_; }
  bool halves() const { return halves_; }  ///< two patches each: u >= v, and u < v
  /// Coefficients of s^i t^j, s = 2u - 1, t = 2v - 1, by i, then j, of all patches, from differences of the piece's
  /// points; the constant ones less slot 0.
  const RowMatrix& matrix() const { return matrix_; }

 private:
  std::vector<Node> nodes_;
  int num_patches_ = 0, num_coefficients_ = 0, degree_ = 0;
  bool total_ = false, halves_ = false;
  RowMatrix matrix_;
};

}  // namespace sublimit

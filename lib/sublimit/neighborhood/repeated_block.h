// SPDX-License-Identifier: Apache-2.0
#pragma once
// Powers of a block of S, for descents towards a vertex with a stationary neighbourhood. Computed by squaring.
//
// If the component of a row along the leading eigenvector vanishes (a second derivative on linear functions, a
// derivative across a crease), it must stay zero: rounding would grow like (lambda/mu)^k relative to the rest.
// The leading eigenvalues are therefore deflated one after another, as long as they are real and semisimple,
// and such rows are multiplied by the deflated block.
#include <array>
#include <memory>
#include <vector>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/neighborhood/piece_block.h"

namespace sublimit {

/// Powers of one block. Computed on first use; threads may share it.
class RepeatedBlock {
 public:
  /// @param block  must outlive this
  explicit RepeatedBlock(const PieceBlock& block) : block_(block) {}
  explicit RepeatedBlock(const PieceBlock&&) = delete;

  /// Returns rows (position, then derivatives) multiplied by the block `times` times.
  RowMatrix pulled_back(const RowMatrix& rows, int times) const;
  /// Returns two rows whose cross product has the direction of the normal, from two such rows `times` steps
  /// later. Rows are scaled to unit length. If both shrink along the same leading eigenvector, it is removed
  /// from one of them.
  RowMatrix tangents_pulled_back(RowMatrix tangents, int times) const;

 private:
  static constexpr int few = 6;  ///< number of steps below which deflation is not worth an eigenproblem
  /// The block with the leading eigenvalues removed.
  struct Stage {
    Eigen::MatrixXd right, left;  ///< eigenvectors of the eigenvalue removed last, left * right = 1
    RowMatrix D;
    std::array<ComputedOnce<RowMatrix>, 13> powers;
    const RowMatrix& power(int i) const;
  };
  using Stages = std::vector<std::unique_ptr<Stage>>;  // the first is the block itself
  const PieceBlock& power(int i) const;
  const Stages& stages() const;
  Stages found_stages() const;
  /// Returns a derivative row multiplied `times` times by the most deflated stage that keeps all components of
  /// the row above rounding.
  /// @param size         norm of rows of this kind, relative to which components count as zero
  /// @param least_stage  stage to use at least
  Eigen::RowVectorXd shrunk(Eigen::RowVectorXd row, double size, int times, size_t least_stage) const;

  const PieceBlock& block_;
  std::array<ComputedOnce<PieceBlock>, 13> powers_;
  ComputedOnce<Stages> stages_;
};

}  // namespace sublimit

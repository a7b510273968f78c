// SPDX-License-Identifier: Apache-2.0
#pragma once
// A block of S many times in a row: the way towards a vertex whose neighbourhood repeats itself. Powers are made by
// squaring.
//
// A row whose part along the leading eigenvector vanishes (a second derivative of what is linear, a derivative across a
// crease) must keep that part zero, else rounding grows like (lambda/mu)^k against the rest. So the leading eigenvalues
// are split off one after the other, as far as they are real and semisimple, and such rows go on with what is left of
// the block.
#include <array>
#include <memory>
#include <vector>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/neighborhood/piece_block.h"

namespace sublimit {

class RepeatedBlock {
 public:
  /// @param block  which must stay
  explicit RepeatedBlock(const PieceBlock& block) : block_(block) {}
  explicit RepeatedBlock(const PieceBlock&&) = delete;

  /// The position, the first of `rows`, `times` steps back, and the rows below it, derivatives.
  RowMatrix pulled_back(const RowMatrix& rows, int times) const;
  /// Two rows whose cross product is along the normal: as these, made such that the second has no part in what the
  /// first shrinks by, where that is slower.
  RowMatrix tangents_pulled_back(RowMatrix tangents, int times) const;

 private:
  static constexpr int few = 6;  ///< times: not worth an eigenproblem
  struct Stage {
    Eigen::MatrixXd right, left;  ///< eigenvectors that were split off before it, left * right = 1
    RowMatrix D;
    std::array<FoundOnce<RowMatrix>, 13> powers;
    const RowMatrix& power(int i) const;
  };
  using Stages = std::vector<std::unique_ptr<Stage>>;  // the first has nothing split off
  const PieceBlock& power(int i) const;
  const Stages& stages() const;
  Stages found_stages() const;
  /// A derivative row, by the stage that its leading part allows.
  /// @param size  of rows like this one: what is small is measured by it, as the row itself may be what rounding left
  /// of 0
  Eigen::RowVectorXd shrunk(Eigen::RowVectorXd row, double size, int times, size_t least_stage) const;

  const PieceBlock& block_;
  std::array<FoundOnce<PieceBlock>, 13> powers_;
  FoundOnce<Stages> stages_;
};

}  // namespace sublimit

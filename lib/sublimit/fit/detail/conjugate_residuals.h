// SPDX-License-Identifier: Apache-2.0
#pragma once
// Generalised conjugate residuals: the combination of all steps so far with the least residual, per channel.
// Steps come from a factorised approximation of the matrix, so a few are enough.
// Source: Eisenstat, Elman, Schultz 1983, "Variational iterative methods for nonsymmetric systems of linear equations".
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// The steps so far.
class ConjugateResiduals {
 public:
  explicit ConjugateResiduals(std::size_t memory = 30) : memory_(memory) {}

  /// Orthogonalises a step against earlier ones and stores it.
  /// @param step    step of the unknowns; overwritten by the orthogonalised step
  /// @param effect  matrix * step, which the step takes from the residual; overwritten likewise
  /// @return  step length along `step` per channel
  Eigen::RowVectorXd add(const Points& residual, Points& step, Points& effect) {
    for (const Pair& p : past_) {
      const Eigen::RowVectorXd along = effect.cwiseProduct(p.effect).colwise().sum();
      effect -= p.effect * along.asDiagonal();
      step -= p.step * along.asDiagonal();
    }
    // A step whose effect is negligible is rounding, and normalising would amplify it.
    const Eigen::RowVectorXd whole = residual.colwise().norm();
    Eigen::RowVectorXd length = effect.colwise().norm();
    for (Eigen::Index c = 0; c < length.size(); ++c) length[c] = length[c] > worth * whole[c] ? 1 / length[c] : 0;
    effect = (effect * length.asDiagonal()).eval();
    step = (step * length.asDiagonal()).eval();
    if (past_.size() == memory_) past_.erase(past_.begin());
    past_.push_back({step, effect});
    return residual.cwiseProduct(effect).colwise().sum();
  }

 private:
  struct Pair {
    Points step, effect;
  };
  static constexpr double worth = 1e-5;
  std::size_t memory_;
  std::vector<Pair> past_;
};

}  // namespace sublimit

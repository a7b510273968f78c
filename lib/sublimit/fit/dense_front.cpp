// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/dense_front.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstdint>

#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

constexpr Eigen::Index tile = 192;

/// target -= left * right^T, of the lower half the tiles that reach into it.
/// @param target  as many rows as left; its column j is row j of right, and row j of left where `left` starts with it
template <class Target, class Left>
void subtract_lower(Target&& target, const Left& left) {
  const Eigen::Index rows = target.rows(), columns = target.cols();
  const std::int64_t down = num_blocks(rows, tile), across = num_blocks(columns, tile);
  if (down <= 1) {
    if (rows == columns)
      target.template selfadjointView<Eigen::Lower>().rankUpdate(left, -1);
    else
      target.noalias() -= left * left.topRows(columns).transpose();
    return;
  }
  parallel_for_blocks(
      down * across,
      [&](std::int64_t at, std::int64_t, std::int64_t) {
        const Eigen::Index i = at / across * tile, j = at % across * tile;
        if (i < j) return;
        const Eigen::Index height = std::min(tile, rows - i), width = std::min(tile, columns - j);
        target.block(i, j, height, width).noalias() -=
            left.middleRows(i, height) * left.middleRows(j, width).transpose();
      },
      1);
}

}  // namespace

bool eliminate(Block panel, Block update) {
  const Eigen::Index height = panel.rows(), width = panel.cols();
  for (Eigen::Index k = 0; k < width; k += tile) {
    const Eigen::Index w = std::min(tile, width - k), rest = height - k - w;
    auto diagonal = panel.block(k, k, w, w);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    if (rest == 0) continue;
    auto below = panel.block(k + w, k, rest, w);
    parallel_for_blocks(
        rest,
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          auto rows = below.middleRows(begin, end - begin);
          diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rows);
        },
        tile);
    if (k + w < width) subtract_lower(panel.block(k + w, k + w, rest, width - k - w), below);
  }
  if (height > width) subtract_lower(update, panel.bottomRows(height - width));
  return true;
}

}  // namespace sublimit

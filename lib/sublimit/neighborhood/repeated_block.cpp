// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/repeated_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/core/detail/dense_decompositions.h"

namespace sublimit {
namespace {

/// Parts of a row that are as small as rounding makes what vanishes.
constexpr double negligible = 1e-12;

/// A basis of the null space of M, by columns; `expected` of them or none.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& M, Eigen::Index expected) {
  if (std::optional<Eigen::MatrixXd> clear = clear_null_space(M))
    return clear->cols() == expected ? *std::move(clear) : Eigen::MatrixXd();
  const auto [sigma, right] = singular_values(M);
  const Eigen::Index n = sigma.size();
  const bool clear =
      sigma[n - expected] < 1e-11 * sigma[0] && (expected == n || sigma[n - expected - 1] > 1e-6 * sigma[0]);
  return clear ? Eigen::MatrixXd(right.rightCols(expected)) : Eigen::MatrixXd();
}

}  // namespace

const RowMatrix& RepeatedBlock::Stage::power(int i) const {
  if (i == 0) return D;
  return powers[i].get([&] { return RowMatrix(power(i - 1) * power(i - 1)); });
}

const PieceBlock& RepeatedBlock::power(int i) const {
  if (i == 0) return block_;
  return powers_[i].get([&] { return power(i - 1).then(power(i - 1)); });
}

const RepeatedBlock::Stages& RepeatedBlock::stages() const {
  return stages_.get([this] { return found_stages(); });
}

RepeatedBlock::Stages RepeatedBlock::found_stages() const {
  Stages stages;
  stages.push_back(std::make_unique<Stage>());
  stages[0]->D = block_.differences();
  const Eigen::MatrixXd D = stages[0]->D;
  const auto n = D.rows();
  if (n < 2) return stages;
  Eigen::VectorXcd values = eigenvalues(D);
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  for (Eigen::Index at = 0; at < n && stages.size() < 6;) {
    const double lambda = values[at].real(), modulus = std::abs(values[at]);
    Eigen::Index count = 0;
    bool real = true;
    while (at + count < n && std::abs(values[at + count]) > modulus * (1 - 1e-6)) {
      real &= std::abs(values[at + count].imag()) < 1e-7 * modulus &&
              std::abs(values[at + count].real() - lambda) < 1e-6 * modulus;
      ++count;
    }
    if (!real || modulus < 1e-3) return stages;
    const double mean = values.segment(at, count).real().mean();
    const Eigen::MatrixXd shifted = D - mean * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd right = null_space(shifted, count), left = null_space(shifted.transpose(), count);
    if (right.size() == 0 || left.size() == 0) return stages;
    const Eigen::MatrixXd pairing = left.transpose() * right;
    const PivotedLu lu(pairing);
    if (!lu.is_invertible() || lu.rcond() < 1e-8) return stages;
    auto stage = std::make_unique<Stage>();
    stage->right = right;
    stage->left = lu.solve(left.transpose());
    stage->D = stages.back()->D - mean * right * stage->left;
    stages.push_back(std::move(stage));
    at += count;
  }
  return stages;
}

Eigen::RowVectorXd RepeatedBlock::shrunk(Eigen::RowVectorXd row, double size, int times, size_t least_stage) const {
  const auto& all = stages();
  size_t stage = 0;
  while (stage + 1 < all.size()) {
    const Stage& next = *all[stage + 1];
    const Eigen::RowVectorXd part = row * next.right;
    if (stage + 1 > least_stage && !(part.norm() <= negligible * size)) break;
    row -= part * next.left;
    ++stage;
  }
  for (int i = 0; times >> i; ++i)
    if (times >> i & 1) row = row * all[stage]->power(i);
  return row;
}

RowMatrix RepeatedBlock::pulled_back(const RowMatrix& rows, int times) const {
  if (block_.is_large()) {
    RowMatrix result = rows;
    for (int i = 0; i < times; ++i) result = block_.pulled_back(result);
    return result;
  }
  RowMatrix result = times < few ? rows : RowMatrix(rows.row(0));
  for (int i = 0; times >> i; ++i)
    if (times >> i & 1) result = power(i).pulled_back(result);
  if (times < few) return result;
  result.conservativeResize(rows.rows(), Eigen::NoChange);
  for (const auto& [first, count] : {std::pair{1, 2}, {3, 3}}) {  // of one order
    if (first >= rows.rows()) break;
    const double size = rows.middleRows(first, count).rowwise().norm().maxCoeff();
    for (int k = first; k < first + count; ++k) result.row(k) = shrunk(rows.row(k), size, times, 0);
  }
  return result;
}

RowMatrix RepeatedBlock::tangents_pulled_back(RowMatrix tangents, int times) const {
  if (block_.is_large()) {
    for (int i = 0; i < times; ++i) tangents = block_.derivatives_pulled_back(tangents);
    return tangents;
  }
  const auto& all = stages();
  const double size = tangents.rowwise().norm().maxCoeff();
  size_t first = 1;  // the eigenvectors that shrink the least, of those that the rows see: others are of far points
  const auto seen = [&] { return RowMatrix(tangents * all[first]->right); };
  while (first < all.size() && seen().rowwise().norm().maxCoeff() <= negligible * size) ++first;
  int across = -1;  // the row without that direction
  if (times >= few && first < all.size()) {
    // What the rows have of them: one direction, or a plane.
    const RowMatrix leading = seen();
    const int most = leading.row(0).norm() >= leading.row(1).norm() ? 0 : 1, least = 1 - most;
    const double square = leading.row(most).squaredNorm();
    const double factor = square > 0 ? leading.row(least).dot(leading.row(most)) / square : 0;
    const double rest = (leading.row(least) - factor * leading.row(most)).norm();
    if (rest <= 1e-10 * leading.row(most).norm()) {
      tangents.row(least) -= factor * tangents.row(most);
      across = least;
    }
  }
  RowMatrix result(2, tangents.cols());
  for (int k = 0; k < 2; ++k) {
    result.row(k) = shrunk(tangents.row(k), size, times, across == k ? first : 0);
    const double length = result.row(k).norm();  // it means nothing
    if (length > 0) result.row(k) /= length;
  }
  return result;
}

}  // namespace sublimit

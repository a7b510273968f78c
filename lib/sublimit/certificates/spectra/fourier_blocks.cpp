// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/fourier_blocks.h"

#include <algorithm>

#include "sublimit/certificates/spectra/mirror.h"

namespace sublimit {
namespace {

/// That the matrix is real and, for a closed neighbourhood, looks the same from every sector.
void check(const LocalPatch<Algebraic>& patch) {
  const DenseMatrix<Algebraic>& A = patch.A;
  for (Eigen::Index i = 0; i < A.size(); ++i)
    if (!A.data()[i].is_real()) throw AnalysisError("a weight is not real: " + A.data()[i].text());
  if (patch.orbits.empty()) return;
  std::vector<Index> turned(A.rows(), -1);
  for (const std::vector<Index>& orbit : patch.orbits)
    for (size_t s = 0; s < orbit.size(); ++s) turned[orbit[s]] = orbit[(s + 1) % orbit.size()];
  if (std::count(turned.begin(), turned.end(), -1))
    throw AnalysisError("the sectors of a closed neighbourhood do not hold all of its points");
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (!(A(i, j) == A(turned[i], turned[j])))
        throw AnalysisError("the local matrix does not commute with the rotation: " + A(i, j).text() + " and " +
                            A(turned[i], turned[j]).text() + " should be equal");
}

}  // namespace

ExactBlocks exact_blocks(const LocalPatch<Algebraic>& patch) {
  check(patch);
  ExactBlocks result;
  const DenseMatrix<Algebraic>& A = patch.A;
  if (patch.orbits.empty()) {
    if (patch.type.open)
      if (const auto images = mirror_images(patch)) return mirror_blocks(A, *images);
    std::vector<std::vector<Index>> rows;
    for (Eigen::Index i = 0; i < A.rows(); ++i) rows.push_back({static_cast<Index>(i)});
    result.blocks.push_back(A);
    result.orbits.push_back(std::move(rows));
    return result;
  }
  size_t n = 0;
  for (const std::vector<Index>& orbit : patch.orbits) n = std::max(n, orbit.size());
  result.sectors = static_cast<int>(n);
  std::vector<Algebraic> w(n);
  for (size_t t = 0; t < n; ++t) w[t] = Algebraic::root_of_unity(static_cast<long>(t), static_cast<long>(n));
  for (size_t k = 0; 2 * k <= n; ++k) {
    std::vector<std::vector<Index>> orbits;
    for (const std::vector<Index>& orbit : patch.orbits) {
      if (orbit.size() != n && orbit.size() != 1)
        throw AnalysisError("a point comes back to itself after " + std::to_string(orbit.size()) + " of " +
                            std::to_string(n) + " sectors");
      if (orbit.size() == n || k == 0) orbits.push_back(orbit);
    }
    const auto size = std::ssize(orbits);
    DenseMatrix<Algebraic> B(size, size);
    for (std::ptrdiff_t i = 0; i < size; ++i)
      for (std::ptrdiff_t j = 0; j < size; ++j)
        for (size_t t = 0; t < orbits[j].size(); ++t)
          if (const Algebraic& a = A(orbits[i][0], orbits[j][t]); !a.is_zero()) B(i, j) += a * w[k * t % n];
    result.blocks.push_back(std::move(B));
    result.orbits.push_back(std::move(orbits));
  }
  return result;
}

namespace {

/// Tarjan 1972, on the graph of the entries that are not zero.
class Components {
 public:
  explicit Components(const DenseMatrix<Algebraic>& A) : A_(A), order_(A.rows(), -1), low_(A.rows()), open_(A.rows()) {
    for (Index i = 0; i < A.rows(); ++i)
      if (order_[i] < 0) visit(i);
  }
  std::vector<std::vector<Index>> found;

 private:
  void visit(Index i) {
    order_[i] = low_[i] = next_++;
    stack_.push_back(i);
    open_[i] = true;
    for (Index j = 0; j < A_.cols(); ++j) {
      if (A_(i, j).is_zero()) continue;
      if (order_[j] < 0) {
        visit(j);
        low_[i] = std::min(low_[i], low_[j]);
      } else if (open_[j]) {
        low_[i] = std::min(low_[i], order_[j]);
      }
    }
    if (low_[i] != order_[i]) return;
    const auto from = std::find(stack_.begin(), stack_.end(), i);
    found.emplace_back(from, stack_.end());
    stack_.erase(from, stack_.end());
    std::sort(found.back().begin(), found.back().end());
    for (const Index j : found.back()) open_[j] = false;
  }

  const DenseMatrix<Algebraic>& A_;
  std::vector<Index> order_, low_, stack_;
  std::vector<bool> open_;
  Index next_ = 0;
};

}  // namespace

std::vector<std::vector<Index>> strong_components(const DenseMatrix<Algebraic>& A) { return Components(A).found; }

}  // namespace sublimit

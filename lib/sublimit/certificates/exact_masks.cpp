// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/exact_masks.h"

#include <algorithm>

namespace sublimit {
namespace {

using Matrix = DenseMatrix<Algebraic>;
using Vector = std::vector<Algebraic>;

/// Orbits with the fixed ones first, as `fourier_blocks` has them.
std::vector<std::vector<Index>> sorted_orbits(const LocalPatch<Algebraic>& patch) {
  std::vector<std::vector<Index>> orbits = patch.orbits;
  std::stable_partition(orbits.begin(), orbits.end(), [](const auto& orbit) { return orbit.size() == 1; });
  return orbits;
}

std::size_t sectors(const std::vector<std::vector<Index>>& orbits) {
  std::size_t n = 1;
  for (const auto& orbit : orbits) n = std::max(n, orbit.size());
  return n;
}

Matrix transposed_minus(const Matrix& A, const Algebraic& value) {
  Matrix M = A.transpose();
  for (Eigen::Index i = 0; i < M.rows(); ++i) M(i, i) -= value;
  return M;
}

}  // namespace

Matrix exact_block(const LocalPatch<Algebraic>& patch, int k) {
  const std::vector<std::vector<Index>> orbits = sorted_orbits(patch);
  const auto n = static_cast<long>(sectors(orbits));
  const auto is_fixed = [](const auto& orbit) { return orbit.size() == 1; };
  const auto first = k == 0 ? 0 : std::count_if(orbits.begin(), orbits.end(), is_fixed);
  const auto size = static_cast<Eigen::Index>(orbits.size()) - first;
  Matrix B = Matrix::Constant(size, size, Algebraic(0));
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto &row = orbits[i + first], &columns = orbits[j + first];
      for (size_t t = 0; t < columns.size(); ++t) {
        const Algebraic& a = patch.A(row[0], columns[t]);
        if (!a.is_zero()) B(i, j) += k == 0 ? a : a * Algebraic::root_of_unity(k * static_cast<long>(t), n);
      }
    }
  return B;
}

std::vector<Vector> null_space(Matrix M) {
  const Eigen::Index columns = M.cols();
  std::vector<Eigen::Index> pivots;  // column of each row
  for (Eigen::Index c = 0; c < columns && static_cast<Eigen::Index>(pivots.size()) < M.rows(); ++c) {
    const auto r = static_cast<Eigen::Index>(pivots.size());
    Eigen::Index at = r;
    while (at < M.rows() && M(at, c).is_zero()) ++at;
    if (at == M.rows()) continue;
    if (at != r) M.row(at).swap(M.row(r));
    const Algebraic scale = M(r, c).inverse();
    for (Eigen::Index j = c; j < columns; ++j) M(r, j) *= scale;
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
      if (i == r || M(i, c).is_zero()) continue;
      const Algebraic factor = M(i, c);
      for (Eigen::Index j = c; j < columns; ++j)
        if (!M(r, j).is_zero()) M(i, j) -= factor * M(r, j);
    }
    pivots.push_back(c);
  }
  std::vector<Vector> basis;
  for (Eigen::Index c = 0; c < columns; ++c) {
    if (std::find(pivots.begin(), pivots.end(), c) != pivots.end()) continue;
    Vector x(columns, Algebraic(0));
    x[c] = 1;
    for (size_t r = 0; r < pivots.size(); ++r) x[pivots[r]] = -M(static_cast<Eigen::Index>(r), c);
    basis.push_back(std::move(x));
  }
  return basis;
}

ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda) {
  ExactMasks masks;
  const auto size = patch.slots.size();
  if (patch.orbits.empty()) {
    std::vector<Vector> left = null_space(transposed_minus(patch.A, 1));
    if (left.size() != 1) throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple");
    Algebraic sum = 0;
    for (const Algebraic& w : left[0]) sum += w;
    for (Algebraic& w : left[0]) w /= sum;
    masks.position = std::move(left[0]);
    return masks;
  }
  const std::vector<std::vector<Index>> orbits = sorted_orbits(patch);
  const auto n = static_cast<long>(sectors(orbits));
  const std::vector<Vector> left = null_space(transposed_minus(exact_block(patch, 0), 1));
  if (left.size() != 1) throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple");
  Algebraic sum = 0;
  for (const Algebraic& w : left[0]) sum += w;
  masks.position.resize(size);
  for (size_t i = 0; i < orbits.size(); ++i)
    for (const Index slot : orbits[i]) masks.position[slot] = left[0][i] / (sum * static_cast<long>(orbits[i].size()));

  if (!lambda) return masks;
  const Matrix B = exact_block(patch, 1);
  const std::vector<Vector> l = null_space(transposed_minus(B, *lambda)),
                            r = null_space(transposed_minus(B.transpose(), *lambda));
  if (l.size() != 1 || r.size() != 1) return masks;
  Algebraic overlap = 0;
  for (size_t i = 0; i < l[0].size(); ++i) overlap += l[0][i] * r[0][i];
  if (overlap.is_zero() || r[0][0].is_zero()) return masks;
  const Algebraic scale = r[0][0] / overlap * Algebraic::ratio(1, n);
  masks.tangent1.emplace(size, Algebraic(0));
  masks.tangent2.emplace(size, Algebraic(0));
  const auto fixed = orbits.size() - l[0].size();
  const Algebraic i_unit = Algebraic::root_of_unity(1, 4);
  for (size_t i = fixed; i < orbits.size(); ++i)
    for (long s = 0; s < n; ++s) {
      const Algebraic w = l[0][i - fixed] * scale * Algebraic::root_of_unity(-s, n), c = w.conj();
      (*masks.tangent1)[orbits[i][s]] = w + c;
      (*masks.tangent2)[orbits[i][s]] = (w - c) * i_unit;  // -2 Im w
    }
  return masks;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/supernodes.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <numeric>

namespace sublimit {
namespace {

/// Columns below the diagonal, by row, in the new order; not sorted.
struct Lower {
  std::vector<std::int64_t> begin;
  std::vector<Index> columns;

  Lower(const SparseMatrix& M, const std::vector<Index>& order, const std::vector<Index>& inverse)
      : begin(order.size() + 1, 0) {
    columns.reserve(M.nonZeros() / 2);
    for (size_t i = 0; i < order.size(); ++i) {
      for (SparseMatrix::InnerIterator e(M, order[i]); e; ++e)
        if (inverse[e.col()] < Index(i)) columns.push_back(inverse[e.col()]);
      begin[i + 1] = std::int64_t(columns.size());
    }
  }
};

std::vector<Index> inverse_of(const std::vector<Index>& order) {
  std::vector<Index> inverse(order.size());
  for (size_t i = 0; i < order.size(); ++i) inverse[order[i]] = Index(i);
  return inverse;
}

/// The row of the first entry below the diagonal of every column of L; -1 if there is none.
std::vector<Index> elimination_tree(const Lower& lower) {
  const Index n = Index(lower.begin.size()) - 1;
  std::vector<Index> parent(n, -1), ancestor(n, -1);
  for (Index i = 0; i < n; ++i)
    for (std::int64_t k = lower.begin[i]; k < lower.begin[i + 1]; ++k)
      for (Index j = lower.columns[k], next; j != -1 && j < i; j = next) {
        next = ancestor[j];
        ancestor[j] = i;
        if (next == -1) parent[j] = i;
      }
  return parent;
}

std::vector<Index> postorder(const std::vector<Index>& parent) {
  const Index n = Index(parent.size());
  std::vector<Index> child(n + 1, -1), sibling(n, -1), result, path;
  for (Index j = n - 1; j >= 0; --j) {
    const Index p = parent[j] < 0 ? n : parent[j];
    sibling[j] = child[p];
    child[p] = j;
  }
  result.reserve(n);
  for (Index root = child[n]; root != -1; root = sibling[root]) {
    path.push_back(root);
    while (!path.empty()) {
      const Index j = path.back();
      if (child[j] != -1) {
        path.push_back(child[j]);
        child[j] = sibling[child[j]];
      } else {
        result.push_back(j);
        path.pop_back();
      }
    }
  }
  return result;
}

/// Entries below the diagonal of every column of L: row i has those on the paths from its columns towards i.
std::vector<Index> column_counts(const Lower& lower, const std::vector<Index>& parent) {
  const Index n = Index(parent.size());
  std::vector<Index> count(n, 0), seen(n, -1);
  for (Index i = 0; i < n; ++i) {
    seen[i] = i;
    for (std::int64_t k = lower.begin[i]; k < lower.begin[i + 1]; ++k)
      for (Index j = lower.columns[k]; seen[j] != i; j = parent[j]) {
        seen[j] = i;
        ++count[j];
      }
  }
  return count;
}

/// Blocks with a few zeros are faster than many thin ones.
bool worth_merging(double width, double zeros, double entries) {
  const double share = zeros / entries;
  return width <= 4 ? share < 0.8 : width <= 16 ? share < 0.2 : width <= 48 ? share < 0.1 : share < 0.05;
}

/// First columns of supernodes, and the end.
std::vector<Index> merged_columns(const std::vector<Index>& parent, const std::vector<Index>& count) {
  struct Block {
    Index first, width, below;
    double zeros;
  };
  const Index n = Index(parent.size());
  std::vector<Block> blocks;
  for (Index j = 0; j < n;) {
    Index end = j + 1;
    while (end < n && parent[end - 1] == end && count[end - 1] == count[end] + 1) ++end;
    Block block{j, end - j, count[end - 1], 0};
    while (!blocks.empty()) {
      const Block& child = blocks.back();
      const Index up = parent[block.first - 1];
      if (up < 0 || up >= end) break;
      const double width = child.width + block.width, height = width + block.below;
      const double zeros =
          child.zeros + block.zeros + double(child.width) * (double(block.width) + block.below - child.below);
      if (!worth_merging(width, zeros, width * (height - width / 2))) break;
      block = {child.first, child.width + block.width, block.below, zeros};
      blocks.pop_back();
    }
    blocks.push_back(block);
    j = end;
  }
  std::vector<Index> first;
  for (const Block& b : blocks) first.push_back(b.first);
  first.push_back(n);
  return first;
}

}  // namespace

double Supernodes::entries() const {
  double sum = 0;
  for (Index s = 0; s < count(); ++s) sum += double(width(s)) * (double(width(s)) + below(s));
  return sum;
}

double Supernodes::work(Index s) const {
  const double w = width(s), b = below(s);
  return w * (w + b) * (w + b) + 50 * (w + b);
}

Supernodes supernodes(const SparseMatrix& M) {
  const Index n = Index(M.rows());
  Supernodes result;
  {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> permutation;
    const Eigen::SparseMatrix<double, Eigen::ColMajor, Index> columns = M;
    Eigen::AMDOrdering<Index>()(columns.selfadjointView<Eigen::Lower>(), permutation);
    result.order.assign(permutation.indices().data(), permutation.indices().data() + n);
  }
  result.inverse = inverse_of(result.order);
  const std::vector<Index> post = postorder(elimination_tree(Lower(M, result.order, result.inverse)));
  std::vector<Index> order(n);
  for (Index i = 0; i < n; ++i) order[i] = result.order[post[i]];
  result.order = order;
  result.inverse = inverse_of(order);

  const Lower lower(M, result.order, result.inverse);
  const std::vector<Index> tree = elimination_tree(lower);
  result.first = merged_columns(tree, column_counts(lower, tree));
  const Index blocks = Index(result.first.size()) - 1;
  std::vector<Index> block_of(n);
  for (Index s = 0; s < blocks; ++s)
    std::fill(block_of.begin() + result.first[s], block_of.begin() + result.first[s + 1], s);

  result.parent.assign(blocks, -1);
  result.first_descendant.resize(blocks);
  std::iota(result.first_descendant.begin(), result.first_descendant.end(), 0);
  result.rows_begin.assign(1, 0);
  std::vector<Index> seen(n, -1);
  std::vector<std::vector<Index>> children(blocks);
  for (Index s = 0; s < blocks; ++s) {
    const Index end = result.first[s + 1];
    const auto add = [&](Index row) {
      if (row < end || seen[row] == s) return;
      seen[row] = s;
      result.rows.push_back(row);
    };
    for (Index j = result.first[s]; j < end; ++j)
      for (SparseMatrix::InnerIterator e(M, result.order[j]); e; ++e) add(result.inverse[e.col()]);
    for (const Index c : children[s]) {
      for (std::int64_t k = result.rows_begin[c]; k < result.rows_begin[c + 1]; ++k) add(result.rows[k]);
      result.first_descendant[s] = std::min(result.first_descendant[s], result.first_descendant[c]);
    }
    std::sort(result.rows.begin() + result.rows_begin[s], result.rows.end());
    result.rows_begin.push_back(std::int64_t(result.rows.size()));
    if (result.below(s) == 0) continue;
    result.parent[s] = block_of[*result.rows_of(s)];
    children[result.parent[s]].push_back(s);
  }
  return result;
}

}  // namespace sublimit

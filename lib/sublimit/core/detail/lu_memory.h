// SPDX-License-Identifier: Apache-2.0
#pragma once
// Handling of allocation failures in Eigen's SparseLU. Include it with <Eigen/SparseLU>, before factors are
// computed.
#include <Eigen/SparseLU>

#include <algorithm>
#include <new>
#include <string>

namespace sublimit {

/// Grows an array of SparseLU, or leaves it unchanged if memory is short. (Eigen 3.4 frees the old array before
/// it allocates the new one, and again if that fails.)
/// @param length       current number of elements; for a first allocation the requested number
/// @param num_kept     number of leading elements to keep
/// @param keep_length  true: allocate exactly `length` elements
/// @return 0, or as in Eigen: -1 if a first allocation failed, else the length for which there was no memory
template <class Array>
Eigen::Index grow_factors(Array& array, Eigen::Index& length, Eigen::Index num_kept, bool keep_length,
                          Eigen::Index& num_expansions) {
  const bool first = num_expansions == 0;
  for (double growth = 1.5;; growth = (growth + 1) / 2) {
    const Eigen::Index wanted =
        first || keep_length ? length : std::max(length + 1, static_cast<Eigen::Index>(growth * double(length)));
    try {
      Array larger(wanted);
      larger.head(num_kept) = array.head(num_kept);
      array.swap(larger);
    } catch (const std::bad_alloc&) {
      if (first) return -1;
      if (keep_length || wanted == length + 1) return wanted;
      continue;
    }
    length = wanted;
    if (!first) ++num_expansions;
    return 0;
  }
}

/// Finds relaxed supernodes: whole subtrees of the elimination tree with few columns, which are treated as one.
/// (Eigen 3.4 frees an array twice here if memory is short.)
/// @param parents  parent of each column, n for none; ascending towards the root
/// @param most     the number of columns below the root of a subtree is less than this
/// @param below    result: number of columns below each one
/// @param last     result: last column of the subtree that starts with a column; -1 if none does
template <class Array>
void find_relaxed_columns(Eigen::Index n, const Array& parents, Eigen::Index most, Array& below, Array& last) {
  using Column = typename Array::Scalar;
  Array position, column(n + 1), parent(n);  // by position in postorder: its column, its parent's position
  Eigen::internal::treePostorder(static_cast<Column>(n), const_cast<Array&>(parents), position);
  for (Eigen::Index j = 0; j <= n; ++j) column(position(j)) = static_cast<Column>(j);
  for (Eigen::Index j = 0; j < n; ++j) parent(position(j)) = position(parents(j));
  below.setZero();
  last.setConstant(-1);
  for (Eigen::Index i = 0; i < n; ++i)
    if (parent(i) != n) below(parent(i)) += below(i) + 1;
  for (Eigen::Index i = 0; i < n;) {
    const Eigen::Index begin = i;
    while (parent(i) != n && below(parent(i)) < most) i = parent(i);
    const auto columns = column.segment(begin, i - begin + 1);
    if (const Column first = columns.minCoeff(); columns.maxCoeff() - first == i - begin)
      last(first) = columns.maxCoeff();
    else
      for (Eigen::Index k = begin; k <= i; ++k)
        if (below(k) == 0) last(column(k)) = column(k);
    for (++i; i < n && below(i) != 0;) ++i;  // to the next leaf
  }
}

/// Throws if a factorisation failed for lack of memory. SparseLU catches the exception, sets its error text,
/// and may leave its status unchanged.
/// @throws std::bad_alloc  memory was short
template <class Lu>
void check_memory_of(const Lu& lu) {
  if (lu.lastErrorMessage().find("MEMORY") != std::string::npos) throw std::bad_alloc();
}

}  // namespace sublimit

/// @cond eigen_members
namespace Eigen::internal {

template <>
template <>
inline Index SparseLUImpl<double, int>::expand(Matrix<double, Dynamic, 1>& array, Index& length, Index num_kept,
                                               Index keep_length, Index& num_expansions) {
  return sublimit::grow_factors(array, length, num_kept, keep_length != 0, num_expansions);
}
template <>
template <>
inline Index SparseLUImpl<double, int>::expand(Matrix<int, Dynamic, 1>& array, Index& length, Index num_kept,
                                               Index keep_length, Index& num_expansions) {
  return sublimit::grow_factors(array, length, num_kept, keep_length != 0, num_expansions);
}

template <>
inline void SparseLUImpl<double, int>::heap_relax_snode(const Index n, IndexVector& parents, const Index most,
                                                        IndexVector& below, IndexVector& last) {
  sublimit::find_relaxed_columns(n, parents, most, below, last);
}

}  // namespace Eigen::internal
/// @endcond

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lack of memory in Eigen's SparseLU. Included where <Eigen/SparseLU> is, before its factors are made.
#include <Eigen/SparseLU>

#include <algorithm>
#include <new>
#include <string>

namespace sublimit {

/// Grows an array of SparseLU, or leaves it as it is where memory lacks. Eigen 3.4 frees the old array before it asks
/// for the new one, and once more if there is none.
/// @param length       elements there are (to begin with: that are wanted)
/// @param num_kept     first elements that stay
/// @param keep_length  `length` elements are wanted, no more
/// @return 0, or as Eigen has it: -1 where the first array lacks, else the length that there was no memory for
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

/// Throws if a factorization ended for want of memory: SparseLU catches that, says it in words and may leave its status
/// as it was.
/// @throws std::bad_alloc  it did
template <class Lu>
void check_memory_of(const Lu& lu) {
  if (lu.lastErrorMessage().find("MEMORY") != std::string::npos) throw std::bad_alloc();
}

}  // namespace sublimit

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

}  // namespace Eigen::internal

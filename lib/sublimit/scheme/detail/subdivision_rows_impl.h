// SPDX-License-Identifier: Apache-2.0
#pragma once
// Single rows of a subdivision matrix, in any number type (documented in subdivision_rows.h).
#include <span>
#include <vector>

#include "sublimit/scheme/detail/subdivision_matrix_impl.h"

namespace sublimit {

template <class T>
SparseMatrixOf<T> subdivision_rows(const Scheme<T>& scheme, const Step<T>& step, const Topology& parent,
                                   const Refinement& refinement, const Sharpness& sharpness,
                                   const Sharpness& child_sharpness, int level, std::span<const Index> rows,
                                   const KnotSplit* knots) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(parent, sharpness);
  assembly::RowMaker<T> maker(scheme, step, parent, refinement, sharpness, child_sharpness, level, knots, plain);
  const Index count = refinement.topology.num_vertices(), width = parent.num_vertices();
  SparseMatrixOf<T> S(count, width);
  std::vector<Index> columns(static_cast<size_t>(width));  // no row is longer
  std::vector<T> values(columns.size());
  Index* const outer = S.outerIndexPtr();
  std::vector<Index> all_columns;
  std::vector<T> all_values;
  size_t next = 0;
  for (Index r = 0; r < count; ++r) {
    outer[r] = static_cast<Index>(all_columns.size());
    if (next == rows.size() || rows[next] != r) continue;
    ++next;
    const Index length = assembly::write_row(maker, refinement, Vertex{r}, columns.data(), values.data());
    all_columns.insert(all_columns.end(), columns.begin(), columns.begin() + length);
    all_values.insert(all_values.end(), values.begin(), values.begin() + length);
  }
  outer[count] = static_cast<Index>(all_columns.size());
  resize_nonzeros(S, outer[count]);
  std::copy(all_columns.begin(), all_columns.end(), S.innerIndexPtr());
  std::copy(all_values.begin(), all_values.end(), S.valuePtr());
  return S;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/subdivision_rows.h"

#include <vector>

#include "sublimit/scheme/subdivision_matrix_impl.h"

namespace sublimit {
namespace {

using Maker = assembly::RowMaker<double>;

}  // namespace

SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Step<double>& step, const Topology& parent,
                              const Refinement& refinement, const Sharpness& sharpness,
                              const Sharpness& child_sharpness, int level, std::span<const Index> rows,
                              const KnotSplit* knots) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(parent, sharpness);
  Maker maker(scheme, step, parent, refinement, sharpness, child_sharpness, level, knots, plain);
  const Index count = refinement.topology.num_vertices(), width = parent.num_vertices();
  SparseMatrix S(count, width);
  Index* const outer = S.outerIndexPtr();
  std::vector<Index> columns;
  std::vector<double> values;
  Index at = 0;
  size_t next = 0;
  for (Index r = 0; r < count; ++r) {
    outer[r] = at;
    if (next == rows.size() || rows[next] != r) continue;
    ++next;
    if (columns.size() < size_t(at) + size_t(width)) {  // no row is longer
      columns.resize(2 * columns.size() + size_t(width));
      values.resize(columns.size());
    }
    at += assembly::write_row(maker, refinement, Vertex{r}, columns.data() + at, values.data() + at);
  }
  outer[count] = at;
  resize_nonzeros(S, at);
  std::copy_n(columns.begin(), at, S.innerIndexPtr());
  std::copy_n(values.begin(), at, S.valuePtr());
  return S;
}

SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Level& parent, const Level& child,
                              std::span<const Index> vertices) {
  if (scheme.steps.size() > 1) return child.S;
  const std::optional<KnotSplit> knots = parent.knots();
  return subdivision_rows(scheme, scheme.steps[0], parent.topology(), child.steps[0], parent.sharpness, child.sharpness,
                          parent.number, vertices, knots ? &*knots : nullptr);
}

}  // namespace sublimit

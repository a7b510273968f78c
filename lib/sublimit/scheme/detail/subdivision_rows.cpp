// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/subdivision_rows.h"

#include "sublimit/scheme/detail/subdivision_rows_impl.h"

namespace sublimit {

SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Step<double>& step, const Topology& parent,
                              const Refinement& refinement, const Sharpness& sharpness,
                              const Sharpness& child_sharpness, int level, std::span<const Index> rows,
                              const KnotSplit* knots) {
  return subdivision_rows<double>(scheme, step, parent, refinement, sharpness, child_sharpness, level, rows, knots);
}

SparseMatrix subdivision_rows(const Scheme<double>& scheme, const Level& parent, const Level& child,
                              std::span<const Index> vertices) {
  if (scheme.steps.size() > 1) return child.S;
  const std::optional<KnotSplit> knots = parent.knots();
  return subdivision_rows(scheme, scheme.steps[0], parent.topology(), child.steps[0], parent.sharpness, child.sharpness,
                          parent.number, vertices, knots ? &*knots : nullptr);
}

}  // namespace sublimit

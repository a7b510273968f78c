// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake/bake_patterns.h"

namespace sublimit {

std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      const PatternBake& how) {
  if (!control.intervals.empty()) return std::nullopt;  // lattices have new knots in the middle
  std::optional<Baked> baked;
  if (request.rows == TableRows::level || request.rows == TableRows::limit)
    baked = bake_lattices(patterns, control, request, how);
  else if (request.rows == TableRows::grid && !how.first_by_rows)
    baked = bake_grids(patterns, control, request, how);
  if (baked) baked->statistics.method = how.first_by_rows ? BakeMethod::rows_then_patterns : BakeMethod::patterns;
  return baked;
}

}  // namespace sublimit

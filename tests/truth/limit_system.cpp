// SPDX-License-Identifier: Apache-2.0
#include "truth/limit_system.h"

#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {

SparseMatrix limit_system(const std::string& scheme, const Mesh& mesh) {
  LimitCache cache(find_scheme<double>(scheme).value());
  return limit_matrices(refine(cache.scheme(), mesh, 0)[0], cache).position;
}

}  // namespace sublimit::testing

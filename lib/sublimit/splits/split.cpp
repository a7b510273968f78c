// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/split.h"

#include <limits>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/splits/primal.h"

namespace sublimit {

std::int64_t num_child_half_edges(const Topology& parent, Split) {
  return 4 * std::int64_t{parent.num_half_edges()};  // pqq: a quad per corner; ptq: four triangles per three corners
}

Refinement refine(const Topology& parent, Split split) {
  const std::int64_t count = num_child_half_edges(parent, split);
  if (count > std::numeric_limits<Index>::max())
    throw ResourceError("the next level has " + std::to_string(count) + " face corners, more than 32-bit indices count (" +
                        std::to_string(std::numeric_limits<Index>::max()) + "); use fewer levels or refine fewer faces");
  return split == Split::pqq ? refine_pqq(parent) : refine_ptq(parent);
}

std::pair<HalfEdge, HalfEdge> Refinement::halves(const Topology& parent, HalfEdge h) const {
  return split == Split::pqq ? pqq_halves(parent, h) : ptq_halves(parent, h);
}

}  // namespace sublimit

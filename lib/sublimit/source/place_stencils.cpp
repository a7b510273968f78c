// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/place_stencils.h"

#include "sublimit/source/detail/stencil_matrices.h"

namespace sublimit {

PlaceStencils place_stencils(const LinearSource& surface, std::span<const Place> places, int derivatives) {
  return stencil_matrices(surface, places, derivatives, &LimitStencil::vertices,
                          derivatives == 0   ? 1
                          : derivatives == 1 ? 3
                                             : 6,
                          surface.num_points());
}

}  // namespace sublimit

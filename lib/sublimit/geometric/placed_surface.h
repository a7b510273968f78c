// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces that are not linear in their data, already bound to data: the counterpart of LinearSource.
#include <vector>

#include "sublimit/source/linear_source.h"

namespace sublimit {

/// A surface with data that can be evaluated anywhere.
class PlacedSurface : public BoundSource {
 public:
  virtual FaceCount faces() const = 0;
};

/// Returns several surfaces as one, with the faces of one surface after those of the other. Results have the
/// same bits as those of the parts.
/// @param parts  at least one; all with triangles, or all with squares
/// @throws InvalidParameter  no parts, or parts with different kinds of faces
/// @throws ResourceError     more faces than 32-bit indices count
std::shared_ptr<const PlacedSurface> placed_together(std::vector<std::shared_ptr<const PlacedSurface>> parts);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A surface that is not linear in its data, anywhere: what LinearSource is for those that are, already bound to data.
#include <vector>

#include "sublimit/limit/linear_source.h"

namespace sublimit {

class PlacedSurface : public BoundSource {
 public:
  virtual FaceCount faces() const = 0;
};

/// Several as one, their faces one surface after the other; places have the bits that they have on their own.
/// @param parts  one at least, all of triangles or all of squares
/// @throws InvalidParameter  none, or both kinds of faces;  ResourceError  more faces than 32-bit indices count
std::shared_ptr<const PlacedSurface> placed_together(std::vector<std::shared_ptr<const PlacedSurface>> parts);

}  // namespace sublimit

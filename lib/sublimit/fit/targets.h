// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets of a fit: points, or values in any number of channels, that a surface should have at given places.
//
//   PlaceTargets targets;
//   targets.places = {{.face = 0, .u = 0.5, .v = 0.5}, {.face = 1, .u = 0, .v = 0}};
//   targets.values = Points{{0, 0, 1}, {1, 0, 0}};
//   const ScatteredFit fitted = fit_places(surface.map(), targets, surface.points());
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/mesh/vertex_target.h"
#include "sublimit/source/address.h"

namespace sublimit {

/// Places of a surface and the values that it should have there. Plain data.
struct PlaceTargets {
  std::vector<Place> places = {};
  Points values = {};                ///< #places x channels
  std::vector<double> weights = {};  ///< weights of the squared distances, >= 0; empty: all 1
};

}  // namespace sublimit

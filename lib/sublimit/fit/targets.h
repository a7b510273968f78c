// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a limit surface is asked to pass through. Plain data.
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/limit/address.h"
#include "sublimit/mesh/vertex_target.h"

namespace sublimit {

/// Places of the limit and what it should be there: as many channels as wanted.
struct PlaceTargets {
  std::vector<Sample> places = {};
  Points values = {};                ///< #places x channels
  std::vector<double> weights = {};  ///< >= 0, of the squared distances; empty: all 1
};

}  // namespace sublimit

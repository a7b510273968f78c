// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/join_orders.h"

namespace sublimit {

std::string_view name(JoinObstacle obstacle) {
  switch (obstacle) {
    case JoinObstacle::none:
      return "none";
    case JoinObstacle::gap:
      return "gap";
    case JoinObstacle::pole:
      return "pole";
    case JoinObstacle::no_tangent:
      return "no-tangent";
    case JoinObstacle::angle:
      return "angle";
    case JoinObstacle::folded_back:
      return "folded-back";
    case JoinObstacle::undecided:
      return "undecided";
    case JoinObstacle::no_speed:
      return "no-speed";
    case JoinObstacle::curvature:
      return "curvature";
  }
  return "";
}

}  // namespace sublimit

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

std::string c_words(const JoinOrders& orders) {
  return orders.is_same ? "C^infinity" : "C^" + std::to_string(orders.c);
}

std::string g_words(const JoinOrders& orders) {
  if (orders.obstacle != JoinObstacle::none) return "G^" + std::to_string(orders.g);
  return orders.is_same ? "G^infinity" : "G^" + std::to_string(orders.g) + " at least";
}

std::string words_of(const JoinOrders& orders) {
  if (orders.g < 0) return orders.obstacle == JoinObstacle::pole ? "a pole" : "a gap";
  std::string words = c_words(orders) + ", " + g_words(orders);
  if (orders.obstacle != JoinObstacle::none) words += " (" + std::string(name(orders.obstacle)) + ")";
  return words;
}

}  // namespace sublimit

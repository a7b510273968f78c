// SPDX-License-Identifier: Apache-2.0
#pragma once
// Statuses of points of the limit in tables, in a byte: the status, and the number of derivatives that exist.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/source/limit_status.h"

namespace sublimit {

/// Returns the status of a point as a byte; 0 if it is regular and all derivatives of the table exist.
/// @param order        order of the derivatives that exist at the point, 0 to 2
/// @param derivatives  order of the derivatives that the table has
constexpr std::uint8_t point_status(LimitStatus status, int order, int derivatives) {
  return static_cast<std::uint8_t>(int(status) + num_limit_statuses * (derivatives - std::min(order, derivatives)));
}

/// Returns the status of a point if it is in a hole.
constexpr std::uint8_t in_hole(std::uint8_t status) {
  return static_cast<std::uint8_t>(status - status % num_limit_statuses + int(LimitStatus::hole));
}

/// Meaning of the numbers of statuses, number by number.
struct PointStatuses {
  std::vector<std::string> words;
  std::vector<std::int8_t> orders;

  explicit PointStatuses(int derivatives) {
    for (int order = derivatives; order >= 0; --order)
      for (int s = 0; s < num_limit_statuses; ++s) {
        words.emplace_back(name(LimitStatus(s)));
        orders.push_back(static_cast<std::int8_t>(order));
      }
  }
};

}  // namespace sublimit

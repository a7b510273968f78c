// SPDX-License-Identifier: Apache-2.0
#pragma once
// Check of the order of derivatives that a caller requests, of curves and of surfaces.
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

/// Throws unless an order of derivatives is 0, 1 or 2.
/// @throws InvalidParameter  another order
inline void check_order(int order) {
  if (order < 0 || order > 2)
    throw InvalidParameter("order " + format_number(order) + ": there are derivatives of order 0, 1 and 2");
}

}  // namespace sublimit

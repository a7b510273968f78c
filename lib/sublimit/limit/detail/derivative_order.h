// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives that can be asked for, of curves and of surfaces: up to the second.
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"

namespace sublimit {

/// @throws InvalidParameter  not 0, 1 or 2
inline void check_order(int order) {
  if (order < 0 || order > 2)
    throw InvalidParameter("order " + format_number(order) + ": there are derivatives of order 0, 1 and 2");
}

}  // namespace sublimit

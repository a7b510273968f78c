// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <numbers>

namespace sublimit {

/// Evaluates a function by golden section search (Kiefer 1953) around its minimum in an interval. The function
/// itself records the best value.
/// @param steps  number of steps, each of which reduces the interval to 0.618 of its length
template <class Function>
void golden_section(const Function& f, double a, double b, int steps) {
  constexpr double golden = 1 / std::numbers::phi;
  double x = b - golden * (b - a), y = a + golden * (b - a), at_x = f(x), at_y = f(y);
  for (int step = 0; step < steps; ++step) {
    if (at_x > at_y) {
      a = x, x = y, at_x = at_y;
      y = a + golden * (b - a), at_y = f(y);
    } else {
      b = y, y = x, at_y = at_x;
      x = b - golden * (b - a), at_x = f(x);
    }
  }
}

}  // namespace sublimit

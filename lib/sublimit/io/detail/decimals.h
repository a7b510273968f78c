// SPDX-License-Identifier: Apache-2.0
#pragma once
// Types for decimal numbers of text files that have none.
#include <algorithm>
#include <cmath>
#include <span>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns float32 if floats hold all digits of the numbers: each is the shortest decimal of its nearest float, such
/// as 0.1. Otherwise float64.
inline ValueType type_of_decimals(std::span<const double> numbers) {
  const auto is_float = [](double x) {
    const auto nearest = static_cast<float>(x);
    if (double{nearest} == x) return true;
    return std::isfinite(nearest) && parse_number<double>(format_number(nearest)).value == x;
  };
  return std::ranges::all_of(numbers, is_float) ? ValueType::float32 : ValueType::float64;
}

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// A curve mask as people type it: `1 4 6 4 1 /8`, `0.25 0.75 0.75 0.25`, `-1/16, 0, 9/16, 1, 9/16, 0, -1/16`.
#include <string>

#include "sublimit/certificates/regularity/symbol.h"

namespace sublimit {

/// Weights by blanks or commas: whole numbers, decimals and ratios; a last word `/N` divides all of them. The weights
/// are those that one old point has in the new ones, in order: every other one makes a mask, and each of these should
/// sum to 1 (curve_regularity says if they do not).
///
/// Zeros at the ends are left out first. If one of the two masks is a single 1 then old points stay, and that weight is
/// the point's own; otherwise an odd number of weights is primal, the middle one being the point's own, and an even
/// number is dual.
/// @throws InvalidOption  what is wrong and where; fewer than 2 weights, more than 41, all zero
Symbol typed_mask(const std::string& text);

/// `weight` as an exact number: `-3`, `0.125`, `5/16`; at most 18 digits.
/// @return  nothing if it is none
std::optional<Rational> typed_number(const std::string& text);

}  // namespace sublimit

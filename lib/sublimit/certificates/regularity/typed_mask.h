// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curve masks typed by users: `1 4 6 4 1 /8`, `0.25 0.75 0.75 0.25`, `-1/16, 0, 9/16, 1, 9/16, 0, -1/16`.
#include <string>

#include "sublimit/certificates/regularity/symbol.h"

namespace sublimit {

/// Returns the symbol of a text: weights separated by blanks or commas, as whole numbers, decimals or
/// fractions; a last word `/N` divides all of them. Weights are those of one old point in the new points, in
/// order. Every other weight belongs to the same mask, and each of the two masks should sum to 1
/// (curve_regularity reports if they do not).
///
/// Zeros at the ends are removed first. If one of the two masks is a single 1, old points are kept, and this
/// weight is the point's own. Otherwise an odd number of weights is primal, with the point's own weight in the
/// middle, and an even number is dual.
/// @throws InvalidOption  malformed text (says what and where), fewer than 2 weights, more than 41, all zero
Symbol typed_mask(const std::string& text);

/// Returns a text as an exact number: `-3`, `0.125`, `5/16`; at most 18 digits.
/// @return  nothing if it is none
std::optional<Rational> typed_number(const std::string& text);

}  // namespace sublimit

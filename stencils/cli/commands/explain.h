// SPDX-License-Identifier: Apache-2.0
#pragma once
// The option --explain of `sample`: the way to the limit at one place.
#include <string>

#include "sublimit/mesh/mesh.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::cli {

/// Returns a place from words like "0,0.25,0.5".
/// @throws InvalidOption  other words
Place explained_place(const std::string& text);

/// Returns the way to the limit at a place, its weights and its point, as lines of text.
std::string explanation(const LimitMap& map, const Points& points, const Place& place);

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rules by the words that options and tables have for them.
#include <optional>
#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// none, edge-only, edge-and-corner
const char* word(Boundary rule);
/// uniform, chaikin
const char* word(Creasing rule);
/// none, corners-only, corners-plus1, corners-plus2, boundaries, all
const char* word(FaceVaryingInterpolation rule);
/// catmark, smooth
const char* word(Triangles rule);

/// The rule of a word, if there is one: `rule_of<Boundary>("edge-only")`.
template <class Rule>
std::optional<Rule> rule_of(const std::string& word);

}  // namespace sublimit

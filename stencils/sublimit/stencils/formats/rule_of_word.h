// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conversion between rules and their words in options and tables.
#include <optional>
#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns the word of a rule: none, edge-only, edge-and-corner.
const char* word(Boundary rule);
/// Returns the word of a rule: uniform, chaikin.
const char* word(Creasing rule);
/// Returns the word of a rule: none, corners-only, corners-plus1, corners-plus2, boundaries, all.
const char* word(FaceVaryingInterpolation rule);
/// Returns the word of a rule: catmark, smooth.
const char* word(Triangles rule);
/// Returns the word of a rule: smooth, linear, drop.
const char* word(Attributes rule);

/// Returns the rule of a word, `rule_of<Boundary>("edge-only")`; absent for other words.
template <class Rule>
std::optional<Rule> rule_of(const std::string& word);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of the rows and masks of witnesses with those of the scheme's file, which the checker of witnesses does
// not know.
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/neighborhood/regular_mask.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::report {

/// A scheme with exact masks, and its mask on regular meshes.
struct ExactScheme {
  Scheme<Algebraic> scheme;
  RegularMask<Algebraic> mask;
};

/// Returns the registered scheme of this name; absent if there is none, or none with these options, or if it
/// has no single mask on regular meshes.
std::optional<ExactScheme> registered_scheme(const std::string& name, const SchemeOptions& options);

/// Returns the differences between a witness of C^1 (certificates/witness/witness.h), which the checker has
/// accepted, and the scheme; empty if there are none.
std::string differs_from(const ExactScheme& exact, const nlohmann::ordered_json& witness);

}  // namespace sublimit::report

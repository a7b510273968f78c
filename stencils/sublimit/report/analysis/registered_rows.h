// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the checker of witnesses cannot see: whether their rows and their mask are those of the scheme's file.
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/neighborhood/regular_mask.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::report {

/// A scheme with exact masks, and its mask on regular meshes.
struct ExactScheme {
  Scheme<Algebraic> scheme;
  RegularMask<Algebraic> mask;
};

/// The registry's scheme of this name; nothing if there is none, or none with these options or one mask.
std::optional<ExactScheme> registered_scheme(const std::string& name, const SchemeOptions& options);

/// What of a witness of C^1 (certificates/witness.h), which the checker has accepted, is not the scheme's; "" if all
/// is.
std::string differs_from(const ExactScheme& exact, const nlohmann::ordered_json& witness);

}  // namespace sublimit::report

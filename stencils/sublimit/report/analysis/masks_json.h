// SPDX-License-Identifier: Apache-2.0
#pragma once
// `masks` of a neighbourhood: decimals from the limit that surfaces are evaluated with, and the exact numbers beside
// them.
#include "sublimit/certificates/spectra/exact_masks.h"
#include "sublimit/stencils/files/numbers.h"

namespace sublimit::report {

/// @param lambda  the subdominant eigenvalue, where it is known exactly
/// @return  null where the scheme has no limit there (and `why` says why not)
Json masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>* exact, const LocalType& type,
                const std::optional<Algebraic>& lambda, std::string& why);

/// Returns the masks of a dart, whose tangents have no exact form in general; the even tangent first.
/// @param exact  local patch of the dart, of one ring
Json dart_masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>& exact, std::string& why);

}  // namespace sublimit::report

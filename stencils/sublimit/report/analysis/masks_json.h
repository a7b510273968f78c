// SPDX-License-Identifier: Apache-2.0
#pragma once
// `masks` of a neighbourhood: decimals from the limit masks by which surfaces are evaluated, and exact numbers
// beside them.
#include "sublimit/certificates/spectra/exact_masks.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {

/// Returns the masks of a neighbourhood other than a dart.
/// @param lambda  subdominant eigenvalue, if it is known exactly
/// @param why     set to the reason if the scheme has no limit there
/// @return  null if the scheme has no limit there
Json masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>* exact, const LocalType& type,
                const std::optional<Algebraic>& lambda, std::string& why);

/// Returns the masks of a dart, whose tangents have no exact form in general; the even tangent first.
/// @param exact  local patch of the dart, of one ring
Json dart_masks_json(const Scheme<double>& scheme, const LocalPatch<Algebraic>& exact, std::string& why);

}  // namespace sublimit::report

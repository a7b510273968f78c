// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks that a level and a cache of limits belong to the same scheme.
#include <string>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// True if two schemes cannot be distinguished on a level: `is_alike` (same_scheme.h), and their masks make the
/// same rows, to the last bit, around some of its faces.
bool is_same_scheme(const Scheme<double>& a, const Scheme<double>& b, const Level& level);

/// Throws unless `scheme` made a level.
/// @param what  object with limits of `scheme`, for the message: "the dictionary (LimitCache)"
/// @throws InvalidParameter  the level was made by another scheme
void check_made_by(const Level& level, const Scheme<double>& scheme, const std::string& what);

/// Throws unless the scheme whose limit is taken is that of an object.
/// @throws InvalidParameter  `scheme` is not the scheme `own` of `what`
void check_same_scheme(const Scheme<double>& scheme, const Scheme<double>& own, const Level& level,
                       const std::string& what);

}  // namespace sublimit

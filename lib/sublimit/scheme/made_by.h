// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels and dictionaries of limits belong to a scheme; here they meet.
#include <string>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Whether two schemes are one as far as a level shows: they are alike, and their masks make the same rows, to the last
/// bit, around some of its faces.
bool is_same_scheme(const Scheme<double>& a, const Scheme<double>& b, const Level& level);

/// @param what  has limits of `scheme`: "the dictionary (LimitTypes)"
/// @throws InvalidParameter  the level was made by another scheme
void check_made_by(const Level& level, const Scheme<double>& scheme, const std::string& what);

/// @throws InvalidParameter  `scheme`, which takes the limit of the level, is not the scheme `own` of `what`
void check_same_scheme(const Scheme<double>& scheme, const Scheme<double>& own, const Level& level,
                       const std::string& what);

}  // namespace sublimit

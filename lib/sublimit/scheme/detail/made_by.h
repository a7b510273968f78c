// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels and dictionaries of limits belong to a scheme; here they meet.
#include <string>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// True if two schemes cannot be distinguished on a level: they are alike (same_scheme.h), and their masks make the
/// same rows, to the last bit, around some of its faces.
bool is_same_scheme(const Scheme<double>& a, const Scheme<double>& b, const Level& level);

/// @param what  has limits of `scheme`: "the dictionary (LimitCache)"
/// @throws InvalidParameter  the level was made by another scheme
void check_made_by(const Level& level, const Scheme<double>& scheme, const std::string& what);

/// @throws InvalidParameter  `scheme`, which takes the limit of the level, is not the scheme `own` of `what`
void check_same_scheme(const Scheme<double>& scheme, const Scheme<double>& own, const Level& level,
                       const std::string& what);

}  // namespace sublimit

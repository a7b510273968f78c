// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whether a limit surface bounds a solid.
#include <string>

#include "sublimit/limit/limit_map.h"

namespace sublimit {

/// Why faces without holes are not all of the surface of a solid, with the edge where it is open; empty if they are.
std::string why_not_closed(const LimitMap& surface);

}  // namespace sublimit

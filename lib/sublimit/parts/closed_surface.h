// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whether a limit surface bounds a solid.
#include <string>

#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Returns why the faces without holes do not bound a solid, with the edge where the surface is open; empty if they do.
std::string why_not_closed(const LimitMap& surface);

}  // namespace sublimit

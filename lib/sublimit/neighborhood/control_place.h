// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where a vertex of a level is on the control mesh, in words: for messages.
#include <string>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// "vertex 7" where it is that vertex's child, or a corner's point beside it; else "a point in face 3", counted from 0.
std::string control_place(const std::vector<Level>& levels, Vertex vertex);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Position of a vertex of a level on the control mesh in words, for messages.
#include <string>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns "vertex 7" for a descendant of this control vertex (in dual schemes: for a point of one of its
/// corners), else "a point in face 3". Numbers start at 0.
std::string control_place(const std::vector<Level>& levels, Vertex vertex);

}  // namespace sublimit

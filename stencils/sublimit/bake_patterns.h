// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables by patterns: a face is a block and a list of control points.
#include <optional>

#include "sublimit/bake.h"
#include "sublimit/face_owners.h"

namespace sublimit {

/// A table by patterns, its `info` left empty.
/// @param first_by_rows  level 1 is made by rows, and has the patterns
/// @param only_count     the table stays empty; `statistics` tell what would be in it
/// @return  nothing where that is not possible, or where blocks would be larger than `most_bytes`
std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      bool first_by_rows, double most_bytes, bool only_count = false,
                                      OwnerRule owners = OwnerRule::balanced);

}  // namespace sublimit

// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is said of places that are on no face, wherever they come from: arrays, files, targets.
#include <cstdint>
#include <string>

#include "sublimit/limit/address.h"

namespace sublimit {

/// Returns which faces places can be on, in words: "faces are 0 to 5, a quad each or a corner of another polygon".
std::string faces_in_words(const FaceCount& faces);

/// Returns why a place is on none of the faces, in words; nothing if it is on one.
/// @param face  of any size, as files have it
std::string why_outside(const FaceCount& faces, std::int64_t face, double u, double v);

}  // namespace sublimit

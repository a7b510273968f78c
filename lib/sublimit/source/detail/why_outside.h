// SPDX-License-Identifier: Apache-2.0
#pragma once
// Words of messages about places that are on no face, shared by arrays, files and targets.
#include <cstdint>
#include <string>

#include "sublimit/source/address.h"

namespace sublimit {

/// Returns a description of the faces that places can be on: "faces are 0 to 5, a quad each or a corner of
/// another polygon".
std::string faces_in_words(const FaceCount& faces);

/// Returns a description of why a place is on none of the faces; empty if it is on one.
/// @param face  face number as given, possibly outside the range of Index
std::string why_outside(const FaceCount& faces, std::int64_t face, double u, double v);

}  // namespace sublimit

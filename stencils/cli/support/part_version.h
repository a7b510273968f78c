// SPDX-License-Identifier: Apache-2.0
#pragma once
// The version of a part that the program loads, to be included once in the part's library. Program and part
// share types, so that both must have the same version.
#include "sublimit/base/version.h"

extern "C" {
extern const char sublimit_part_version[];
const char sublimit_part_version[] = SUBLIMIT_VERSION;
}

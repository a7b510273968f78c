// SPDX-License-Identifier: Apache-2.0
#pragma once
// The version of a part that the program loads, for its own library alone: they share types, so that both must be of
// one version.
#include "sublimit/base/version.h"

extern "C" {
extern const char sublimit_part_version[];
const char sublimit_part_version[] = SUBLIMIT_VERSION;
}

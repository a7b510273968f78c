// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of the program that need large libraries and are loaded on first use.

#include "optional_parts.h"

namespace sublimit::cli {

/// Returns a function of a library that belongs to the program. The library is searched beside the program and
/// where it was installed.
/// @param makes  what the library makes, in the plural, for messages: "CAD files"
/// @throws InvalidOption  no such library; the message has its package, and how to build it
/// @throws IoError        the library cannot be loaded, has another version, or lacks the function
void* loaded_function(const OptionalPart& part, const char* library, const char* function, const char* makes);

}  // namespace sublimit::cli

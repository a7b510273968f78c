// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of the program that need large libraries, loaded when they are wanted.

#include "optional_parts.h"

namespace sublimit::cli {

/// A function of a library that was built with the program, and is looked for beside it and where it was installed.
/// @param makes  what it is for, in the plural: "CAD files"
/// @throws InvalidOption  there is no such library: the message has the package of it, and how to build it
/// @throws IoError  it cannot be loaded, is of another version, or is without the function
void* loaded_function(const OptionalPart& part, const char* library, const char* function, const char* makes);

}  // namespace sublimit::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of the program that need large libraries, loaded when they are wanted.

namespace sublimit::cli {

/// A function of a library that was installed with the program.
/// @param makes  what it is for, in the plural: "CAD files"
/// @throws IoError  no such library, or without the function
void* loaded_function(const char* library, const char* function, const char* makes);

}  // namespace sublimit::cli

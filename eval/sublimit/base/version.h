// SPDX-License-Identifier: Apache-2.0
#pragma once
// The version of sublimit, as macros and as text:
//
//   #if SUBLIMIT_VERSION_MAJOR > 0 || SUBLIMIT_VERSION_MINOR >= 2
//   std::puts(sublimit::version());  // "0.2.0"
//   #endif
#define SUBLIMIT_VERSION_MAJOR 0
#define SUBLIMIT_VERSION_MINOR 2
#define SUBLIMIT_VERSION_PATCH 0
#define SUBLIMIT_VERSION "0.2.0"

namespace sublimit {

/// Returns the version as text, major.minor.patch.
constexpr const char* version() { return SUBLIMIT_VERSION; }

}  // namespace sublimit

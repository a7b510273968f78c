// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>

namespace sublimit::testing {

/// Whether this is the full sweep (ctest -L full), which takes more of the same cases.
inline bool full_sweep() { return std::getenv("SUBLIMIT_FULL") != nullptr; }

}  // namespace sublimit::testing

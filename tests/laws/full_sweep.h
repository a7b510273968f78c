// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>

namespace sublimit::testing {

/// Returns true in the full sweep (ctest -L full), which runs more cases of the same kinds.
inline bool full_sweep() { return std::getenv("SUBLIMIT_FULL") != nullptr; }

}  // namespace sublimit::testing

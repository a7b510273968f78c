// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lack of memory in Eigen's SparseLU.
#include <new>
#include <string>

namespace sublimit {

/// Throws if a factorization ended for want of memory: SparseLU catches that, says it in words and may leave its status
/// as it was.
/// @throws std::bad_alloc  it did
template <class Lu>
void check_memory_of(const Lu& lu) {
  if (lu.lastErrorMessage().find("MEMORY") != std::string::npos) throw std::bad_alloc();
}

}  // namespace sublimit

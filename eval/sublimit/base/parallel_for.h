// SPDX-License-Identifier: Apache-2.0
#pragma once
// Loops over blocks. The split into blocks depends on the range alone, never on the number of threads, so whatever is
// computed per block has the same bits on every machine.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>

namespace sublimit {

/// Rows or elements per block: some tens of microseconds of work, small enough to balance.
inline constexpr std::int64_t block_size = 4096;

constexpr std::int64_t num_blocks(std::int64_t count, std::int64_t size = block_size) {
  return (count + size - 1) / size;
}

/// Calls body(block, begin, end) for every block of [0, count), in parallel.
template <class Body>
void parallel_for_blocks(std::int64_t count, const Body& body, std::int64_t size = block_size) {
  const std::int64_t blocks = num_blocks(count, size);
  const auto run = [&](std::int64_t block) { body(block, block * size, std::min(count, (block + 1) * size)); };
  if (blocks <= 1) {  // small meshes never pay for the scheduler
    if (blocks == 1) run(0);
    return;
  }
  tbb::parallel_for(std::int64_t{0}, blocks, run);
}

/// Calls body(i) for every i of [0, count), in parallel.
template <class Body>
void parallel_for(std::int64_t count, const Body& body) {
  parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace sublimit

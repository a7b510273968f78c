// SPDX-License-Identifier: Apache-2.0
// A loop whose body has a race: whether the thread sanitizer sees it.
#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "sublimit/base/detail/parallel_for.h"

int main() {
  const tbb::global_control several(tbb::global_control::max_allowed_parallelism, 4);
  std::int64_t sum = 0;
  for (int round = 0; round < 3; ++round)
    sublimit::parallel_for_blocks(
        64,
        [&](std::int64_t block, std::int64_t, std::int64_t) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that others come
          sum += block;
        },
        1);
  std::printf("%lld\n", static_cast<long long>(sum));
}

// SPDX-License-Identifier: Apache-2.0
#pragma once
// Temporary arrays on a device that are reused.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sublimit/eval/gpu/detail/driver.h"

namespace sublimit::gpu {

/// A pool of arrays, as many as were ever in use at the same time. Any number of threads may use it.
class MemoryPool {
 public:
  /// @param driver  must outlive the pool
  explicit MemoryPool(Driver& driver) : driver_(driver) {}

  /// An array of at least `bytes` bytes, returned to the pool at the end of the lease.
  class Lease {
   public:
    Lease(MemoryPool& pool, std::int64_t bytes) : pool_(pool) {
      {
        const std::lock_guard lock(pool.mutex_);
        // The smallest that is large enough; else a larger one takes the place of the largest.
        auto best = pool.free_.end();
        for (auto it = pool.free_.begin(); it != pool.free_.end(); ++it)
          if (best == pool.free_.end() || is_better((*it)->num_bytes(), (*best)->num_bytes(), bytes)) best = it;
        if (best != pool.free_.end()) {
          if ((*best)->num_bytes() >= bytes) memory_ = std::move(*best);
          pool.free_.erase(best);
        }
      }
      if (memory_) return;
      memory_ = pool.driver_.allocate(bytes);
      const std::lock_guard lock(pool.mutex_);
      pool.free_.reserve(++pool.num_made_);  // so that it can be given back
    }
    ~Lease() {
      const std::lock_guard lock(pool_.mutex_);
      pool_.free_.push_back(std::move(memory_));
    }
    Lease(const Lease&) = delete;
    Memory* operator->() const { return memory_.get(); }

   private:
    static bool is_better(std::int64_t size, std::int64_t than, std::int64_t needed) {
      if ((size >= needed) != (than >= needed)) return size >= needed;
      return size >= needed ? size < than : size > than;
    }
    MemoryPool& pool_;
    std::unique_ptr<Memory> memory_;
  };

 private:
  Driver& driver_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Memory>> free_;
  size_t num_made_ = 0;
};

}  // namespace sublimit::gpu

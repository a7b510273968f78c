// SPDX-License-Identifier: Apache-2.0
#pragma once
// Temporary arrays that are reused.
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace sublimit {

/// A pool of arrays, as many as were ever in use at the same time. Any number of threads may use it.
///
/// Arrays do not belong to threads: a thread that waits for its loop may meanwhile run another call of the same
/// function.
template <class T>
class BufferPool {
  using Buffer = std::vector<T>;

 public:
  /// An array of the pool, returned to it at the end of the lease.
  class Lease {
   public:
    Lease() = default;
    Lease(BufferPool& pool, std::unique_ptr<Buffer> buffer) : pool_(&pool), buffer_(std::move(buffer)) {}
    Lease(Lease&& other) noexcept = default;
    Lease& operator=(Lease&&) = delete;
    ~Lease() {
      if (!buffer_) return;
      const std::lock_guard lock(pool_->mutex_);
      pool_->free_.push_back(std::move(buffer_));  // there is room: see `take`
    }
    std::span<T> span() const { return buffer_ ? std::span<T>(*buffer_) : std::span<T>(); }

   private:
    BufferPool* pool_ = nullptr;
    std::unique_ptr<Buffer> buffer_;
  };

  /// Returns an array of `count` numbers with undefined values; an empty one if `count` is 0.
  Lease take(size_t count) {
    if (count == 0) return {};
    std::unique_ptr<Buffer> buffer;
    {
      const std::lock_guard lock(mutex_);
      if (free_.empty()) {
        free_.reserve(++made_);
        buffer = std::make_unique<Buffer>();
      } else {
        buffer = std::move(free_.back());
        free_.pop_back();
      }
    }
    buffer->resize(count);
    return {*this, std::move(buffer)};
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Buffer>> free_;
  size_t made_ = 0;
};

}  // namespace sublimit
